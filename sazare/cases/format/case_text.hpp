#pragma once

#include <vector>

#include "sazare/cases/format/document.hpp"
#include "sazare/cases/format/problems.hpp"
#include "sazare/cases/format/schema.hpp"

namespace sazare::cases {

/// The text of a case and what stands where in it.
struct CaseText {
  Value root;
  Problems problems;  // the sources that places refer to, and the warnings so far
};

/// One [table], or one entry of a [[table]].
struct Entry {
  const Value* value = nullptr;  // nullptr when it is not in the file, or not a table (which was reported)
  const Table* table = nullptr;

  bool exists() const { return value != nullptr; }
  bool has(std::string_view key) const { return value != nullptr && value->find(key) != nullptr; }
  /// Absent, or given and right: nothing was reported about it yet.
  bool is_sound(std::string_view key) const { return !has(key) || !value->find(key)->wrong; }
  /// Given, and right.
  bool gives(std::string_view key) const { return has(key) && is_sound(key); }

  Place header() const { return value == nullptr ? Place{} : value->place; }
  /// The value of the key, or the table's header where the key is absent.
  Place place(std::string_view key) const;
  /// The entry `position` of a list, such as the second of `regions`.
  Place place(std::string_view key, std::size_t position) const;
};

/// All entries of a [[table]], or exactly one for a [table], whether or not it is in the file.
std::vector<Entry> entries(const Value& root, const Table& table);

}  // namespace sazare::cases
