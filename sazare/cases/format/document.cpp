#include "sazare/cases/format/document.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/syntax_help.hpp"

namespace sazare::cases {
namespace {

Place place_of(const toml::source_region& region, int source) {
  Place place{source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column), 1};
  const bool one_line = region.end.line == region.begin.line && region.end.column > region.begin.column;
  if (one_line) place.width = static_cast<int>(region.end.column - region.begin.column);
  return place;
}

Value convert(const toml::node& node, int source) {
  Value value;
  value.place = place_of(node.source(), source);
  if (const auto* table = node.as_table()) {
    Value::Members members;
    for (const auto& [key, child] : *table)
      members.push_back({std::string(key.str()), place_of(key.source(), source), convert(child, source)});
    std::ranges::stable_sort(members, {}, &Member::key_place);
    value.data = std::move(members);
  } else if (const auto* array = node.as_array()) {
    Value::Items items;
    for (const auto& child : *array) items.push_back(convert(child, source));
    value.data = std::move(items);
  } else if (const auto* text = node.as_string()) {
    value.data = text->get();
  } else if (const auto* real = node.as_floating_point()) {
    value.data = real->get();
  } else if (const auto* whole = node.as_integer()) {
    value.data = whole->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.data = flag->get();
  }
  return value;
}

}  // namespace

const Value* Value::find(std::string_view key) const {
  const auto* list = members();
  if (list == nullptr) return nullptr;
  const auto found = std::ranges::find(*list, key, &Member::key);
  return found == list->end() ? nullptr : &found->value;
}

Value* Value::find(std::string_view key) { return const_cast<Value*>(std::as_const(*this).find(key)); }

const Place* Value::key_place(std::string_view key) const {
  const auto* list = members();
  if (list == nullptr) return nullptr;
  const auto found = std::ranges::find(*list, key, &Member::key);
  return found == list->end() ? nullptr : &found->key_place;
}

std::optional<Value> parse_document(std::string_view text, int source, Problems& problems, std::span<const Table> known) {
  try {
    return convert(toml::parse(text), source);
  } catch (const toml::parse_error& failure) {
    const Place place = place_of(failure.source(), source);
    const SyntaxMessage message = syntax_message(failure.description(), problems.source(source), place, known);
    problems.error(message.place, message.what, message.help);
    return std::nullopt;
  }
}

std::string describe(const Value& value) {
  if (const auto* text = value.text()) return "the string " + string_text(*text);
  if (const auto* real = std::get_if<double>(&value.data)) return "the number " + short_number(*real, 12);
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return fmt::format("the number {}", *whole);
  if (const auto* flag = std::get_if<bool>(&value.data)) return *flag ? "true" : "false";
  if (const auto* items = value.items())
    return items->empty() ? "an empty list"
                          : fmt::format("a list with {} entr{}", items->size(), items->size() == 1 ? "y" : "ies");
  if (value.is_table()) return "a table";
  return "a date or time";
}

}  // namespace sazare::cases
