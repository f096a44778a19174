#include "sazare/cases/format/csv_fields.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace sazare::cases {

Field trimmed(std::string_view line, std::size_t begin, std::size_t end) {
  while (begin < end && (line[begin] == ' ' || line[begin] == '\t')) ++begin;
  while (end > begin && (line[end - 1] == ' ' || line[end - 1] == '\t')) --end;
  return {line.substr(begin, end - begin), static_cast<int>(begin) + 1};
}

std::vector<Field> split(std::string_view line) {
  std::vector<Field> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = line.find(',', begin);
    if (comma == std::string_view::npos) break;
    fields.push_back(trimmed(line, begin, comma));
    begin = comma + 1;
  }
  fields.push_back(trimmed(line, begin, line.size()));
  return fields;
}

std::string_view without_byte_order_mark(std::string_view line) {
  if (line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
  return line;
}

NumberProblem read_number_field(const Field& field, std::string_view name, Real& value) {
  std::string_view text = field.text;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc{} || end != text.data() + text.size())
    return {fmt::format("{}: a number was expected, found \"{}\"", name, field.text),
            "write numbers such as 1.5e-4, without units"};
  if (std::isfinite(value)) return {};
  return {fmt::format("{} must be a finite number, found {}", name, field.text),
          "remove the row, or enter the intended number"};
}

}  // namespace sazare::cases
