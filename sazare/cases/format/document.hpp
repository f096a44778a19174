#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sazare/cases/format/problems.hpp"
#include "sazare/cases/format/schema.hpp"

/// A case file as a tree of values that know where they were written, with the overrides of the command line
/// put in.
namespace sazare::cases {

struct Value;

struct Member;

/// A date or another value of TOML that no key takes.
struct OtherValue {};

struct Value {
  using Members = std::vector<Member>;
  using Items = std::vector<Value>;
  std::variant<OtherValue, Members, Items, std::string, double, std::int64_t, bool> data;
  Place place;  // of the value; of the header for a [table]
  /// Set by the checker when the value is not what its key takes, so that later checks leave it alone.
  bool wrong = false;

  const Members* members() const { return std::get_if<Members>(&data); }
  const Items* items() const { return std::get_if<Items>(&data); }
  const std::string* text() const { return std::get_if<std::string>(&data); }
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
  const Place* key_place(std::string_view key) const;
  bool is_table() const { return members() != nullptr; }
  bool is_list() const { return items() != nullptr; }
};

struct Member {
  std::string key;
  Place key_place;
  Value value;
};

/// Reads TOML text; a syntax error becomes a problem, and nothing is returned.
/// Where a number was written with a unit, the message says what number to write for the key of that name in `known`.
std::optional<Value> parse_document(std::string_view text, int source, Problems& problems, std::span<const Table> known = {});

/// Puts `table.key=value` (what follows --set) into the document; its values are placed in the override.
void apply_override(Value& root, const std::string& setting, Problems& problems, const std::string& side = "");

/// What the value is, as messages say it: `the string "450 GPa"`, "the number 2.5", "a list of 2".
std::string describe(const Value& value);

}  // namespace sazare::cases
