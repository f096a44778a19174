#include "sazare/cases/format/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/suggest.hpp"

namespace sazare::cases {

std::string range_text(const Range& range) {
  const bool closed = std::isfinite(range.low) && std::isfinite(range.high) && !range.low_open && !range.high_open;
  if (closed) return fmt::format("from {} to {}", short_number(range.low), short_number(range.high));
  std::string out;
  if (std::isfinite(range.low)) out = fmt::format("{} {}", range.low_open ? "greater than" : "at least", short_number(range.low));
  if (std::isfinite(range.high)) {
    if (!out.empty()) out += " and ";
    out += fmt::format("{} {}", range.high_open ? "less than" : "at most", short_number(range.high));
  }
  return out;
}

bool in_range(const Range& range, Real value) {
  const bool above = range.low_open ? value > range.low : value >= range.low;
  const bool below = range.high_open ? value < range.high : value <= range.high;
  return above && below;
}

const Table* find_table(std::span<const Table> schema, std::string_view name) {
  const auto found = std::ranges::find(schema, name, &Table::name);
  return found == schema.end() ? nullptr : &*found;
}

const Key* find_key(const Table& table, std::string_view name) {
  const auto found = std::ranges::find(table.keys, name, &Key::name);
  return found == table.keys.end() ? nullptr : &*found;
}

std::string type_text(const Key& key) {
  const std::string in_unit = key.unit.empty() ? "" : fmt::format(" in {}", key.unit);
  switch (key.type) {
    case Type::text:
      return "a string";
    case Type::choice: {
      const std::vector<std::string> words(key.choices.begin(), key.choices.end());
      return words.size() == 1 ? quoted_list(words) : "one of " + quoted_list(words, "or");
    }
    case Type::boolean:
      return "true or false";
    case Type::number:
      return "a number" + in_unit;
    case Type::integer:
      return "a whole number";
    case Type::vector:
      return "a list of three numbers" + in_unit;
    case Type::names:
      return "a list of names";
    case Type::two_names:
      return "a list of two names";
    case Type::axes:
      return "a list of axes (\"x\", \"y\", \"z\")";
    case Type::file:
      return "a file name";
    case Type::numbers:
      return "a table of names and numbers such as { depth = 3.0 }";
    case Type::values:
      return "a list of numbers" + in_unit;
    case Type::points:
      return "a list of three points [x, y] or more" + in_unit;
  }
  return "";
}

}  // namespace sazare::cases
