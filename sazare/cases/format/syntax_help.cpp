#include "sazare/cases/format/syntax_help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/cases/format/units.hpp"

namespace sazare::cases {
namespace {

struct Assignment {
  std::string key;
  std::string value;
  int value_column = 1;
};

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_key_character(char c) { return is_letter(c) || is_digit(c) || c == '.' || c == '-'; }

/// `key = value   # comment` split by hand, for lines that TOML does not accept; := and : are taken for = too.
bool split_assignment(std::string_view line, Assignment& result) {
  std::size_t at = 0;
  const auto skip = [&](auto is_skipped) {
    while (at < line.size() && is_skipped(line[at])) ++at;
  };
  skip(is_blank);
  const std::size_t key = at;
  skip(is_key_character);
  result.key = line.substr(key, at - key);
  skip(is_blank);
  if (result.key.empty() || at == line.size() || (line[at] != '=' && line[at] != ':')) return false;
  ++at;
  if (at < line.size() && line[at] == '=') ++at;
  skip(is_blank);
  std::size_t end = std::min(line.find('#', at), line.size());
  while (end > at && is_blank(line[end - 1])) --end;
  result.value = line.substr(at, end - at);
  result.value_column = static_cast<int>(at) + 1;
  return true;
}

/// A word or several, without quotes.
bool is_bare_text(std::string_view value) {
  return is_letter(value.front()) && std::ranges::all_of(value, [](char c) { return is_key_character(c) || c == ' '; });
}

/// Digits, a comma, digits.
bool has_decimal_comma(std::string_view value) {
  if (value.starts_with('+') || value.starts_with('-')) value.remove_prefix(1);
  const std::size_t comma = value.find(',');
  if (comma == 0 || comma == std::string_view::npos || comma + 1 == value.size()) return false;
  return std::ranges::all_of(value.substr(0, comma), is_digit) && std::ranges::all_of(value.substr(comma + 1), is_digit);
}

/// Keys are looked up by name alone: which table the line stands in is not known where the text is not TOML.
std::string help_for_unit(const std::string& name, const Quantity& quantity, std::span<const Table> known) {
  for (const Table& table : known) {
    const Key* key = find_key(table, name);
    const auto number = key == nullptr ? std::nullopt : converted(quantity, key->unit);
    if (number) return fmt::format("write {} = {}, without unit; the unit is {}", name, short_number(*number, 12), key->unit);
  }
  return "write the number alone; the reference page gives the unit of each key";
}

std::string help_for_value(const Assignment& line, std::span<const Table> known) {
  if (line.value.empty()) return fmt::format("write a value after \"{} =\"", line.key);
  const auto quantity = parse_quantity(line.value);
  if (quantity && is_unit(quantity->unit)) return help_for_unit(line.key, *quantity, known);
  if (has_decimal_comma(line.value)) return "write a decimal point";
  if (line.value == "True" || line.value == "False") return "write true or false in lower case";
  if (line.value.front() == '.') return "write a digit before the decimal point: 0" + line.value;
  if (is_bare_text(line.value) && line.value != "true" && line.value != "false")
    return fmt::format("enclose text in double quotes: {} = \"{}\"", line.key, line.value);
  return "";
}

std::string help_for_description(std::string_view description) {
  const auto says = [&](std::string_view words) { return description.find(words) != std::string_view::npos; };
  if (says("table header") && says("redefine"))
    return "write each [table] once; entries of a list have double brackets: [[name]]";
  if (says("redefine")) return "this key is given above already; keep one of them";
  if (says("table header")) return "a table header is a name in brackets, alone on its line: [time]";
  if (says("parsing array")) return "close the list with ]";
  if (says("parsing string")) return "close the text with the same quote that begins it";
  if (says("utf-8")) return "save the file as UTF-8";
  if (says("expected '='")) return "write key = value";
  return "";
}

}  // namespace

SyntaxMessage syntax_message(std::string_view description, const Source& source, Place place, std::span<const Table> known) {
  std::string text(description);
  if (text.starts_with("Error while ")) text.erase(0, std::string_view("Error while ").size());
  SyntaxMessage message{place, "not valid TOML: " + text, help_for_description(description)};
  const auto index = static_cast<std::size_t>(place.line - 1);
  if (place.line < 1 || index >= source.lines.size()) return message;
  const std::string& line = source.lines[index];
  message.place.column = std::min(place.column, static_cast<int>(line.size()) + 1);
  Assignment assignment;
  if (!message.help.empty() || !split_assignment(line, assignment)) return message;
  message.help = help_for_value(assignment, known);
  if (!message.help.empty()) {
    message.place.column = assignment.value_column;
    message.place.width = std::max<int>(1, static_cast<int>(assignment.value.size()));
  }
  return message;
}

}  // namespace sazare::cases
