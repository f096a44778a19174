#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "sazare/core/vector.hpp"

/// How tables and keys of case files are described. The lists of a method (its schema.cpp) feed the checker, the reference page,
/// the schema for editors and the writer of resolved cases; no key exists outside them.
namespace sazare::cases {

enum class Type {
  text,
  choice,  // one of `choices`
  boolean,
  number,  // finite, unless `Range::infinite`
  integer,
  vector,     // three numbers
  names,      // a list of names, at least one
  two_names,  // a list of exactly two names
  axes,       // a list of "x", "y", "z"
  file,       // a path relative to the case file
  numbers,    // an inline table of free keys and numbers
  points,     // a list of [x, y]
  values,     // a list of numbers, at least one
};

struct Range {
  Real low = -std::numeric_limits<Real>::infinity();
  Real high = std::numeric_limits<Real>::infinity();
  bool low_open = false;
  bool high_open = false;
  bool infinite = false;  // inf is a value
};

constexpr Range any_number{};
constexpr Range positive{.low = 0, .low_open = true};
constexpr Range not_negative{.low = 0};
constexpr Range positive_or_infinite{.low = 0, .low_open = true, .infinite = true};

/// Between which values the magnitude of a number lies in practice. One outside is warned about, unless it is 0 or infinite.
struct UsualRange {
  Real low = 0;
  Real high = std::numeric_limits<Real>::infinity();
};

/// "greater than 0", "from 3 to 20"; empty when any number will do.
std::string range_text(const Range& range);
bool in_range(const Range& range, Real value);

enum class Need { required, optional };

struct Key {
  std::string_view name;
  Type type = Type::text;
  std::string_view unit = "";
  Range range = any_number;
  UsualRange usual{};
  /// TOML text of the default; empty when there is none or when it is computed (then `note` says how).
  std::string_view default_text = "";
  Need need = Need::optional;
  /// When an optional key is needed after all, or how its default is found: "required when bonded".
  std::string_view note = "";
  std::string_view sentence;
  std::span<const std::string_view> choices = {};
};

struct Table {
  std::string_view name;
  bool repeated = false;  // [[name]]
  Need need = Need::optional;
  std::string_view sentence;
  std::span<const Key> keys;
};

/// nullptr when there is none.
const Table* find_table(std::span<const Table> schema, std::string_view name);
const Key* find_key(const Table& table, std::string_view name);

/// "a number in Pa", "a list of names": what a value of this key looks like.
std::string type_text(const Key& key);

}  // namespace sazare::cases
