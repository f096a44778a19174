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

constexpr int deepest_key =
    64;  // parts of a dotted key; a case has three. toml++ makes a table in a table for each until the stack ends

bool is_bare(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
}

/// Whether a line may hold a key of more parts. Counts the dots between characters of bare keys, and those beside quotes; numbers
/// have one each.
bool has_deep_key(std::string_view line) {
  int in_key = 0, beside_quotes = 0;
  char before = ' ';
  for (const char c : line) {
    if (c == ' ' || c == '\t') continue;
    const bool is_quote = c == '"' || c == '\'', was_quote = before == '"' || before == '\'';
    if (!is_bare(c) && !is_quote) in_key = 0;
    in_key += c == '.' ? 1 : 0;
    beside_quotes += (c == '.' && was_quote) || (before == '.' && is_quote) ? 1 : 0;
    if (in_key >= deepest_key || beside_quotes >= 2 * deepest_key) return true;
    before = c;
  }
  return false;
}

/// The first line with such a key; 0 where there is none. Lines of comments hold none.
int line_of_deep_key(std::string_view text) {
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view content = text.substr(0, end);
    const std::size_t first = content.find_first_not_of(" \t");
    if (first != std::string_view::npos && content[first] != '#' && has_deep_key(content)) return line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return 0;
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
  if (const int line = line_of_deep_key(text); line > 0) {
    problems.error({source, line, 1, 1}, fmt::format("a key has more than {} parts", deepest_key),
                   "a key of a case is table.key");
    return std::nullopt;
  }
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
