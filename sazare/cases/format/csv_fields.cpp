#include "sazare/cases/format/csv_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "sazare/core/plain_text.hpp"

namespace sazare::cases {
namespace {

/// What to do about text that is not one number.
std::string help_for(std::string_view text) {
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (text.find(',') != std::string_view::npos && std::ranges::any_of(text, is_digit))
    return "write a decimal point, and no commas within numbers";
  const auto blank = text.find_first_of(" \t");
  if (blank != std::string_view::npos && blank + 1 < text.size() && is_digit(static_cast<unsigned char>(text[blank + 1])))
    return "write numbers such as 1.5e-4, without blanks between thousands";
  return "write numbers such as 1.5e-4, without units";
}

}  // namespace

Field trimmed(std::string_view line, std::size_t begin, std::size_t end) {
  while (begin < end && (line[begin] == ' ' || line[begin] == '\t')) ++begin;
  while (end > begin && (line[end - 1] == ' ' || line[end - 1] == '\t')) --end;
  return {line.substr(begin, end - begin), static_cast<int>(begin) + 1};
}

char separator_of(std::string_view titles) {
  for (const char separator : {';', ',', '\t'})
    if (titles.find(separator) != std::string_view::npos) return separator;
  return ',';
}

std::vector<Field> split(std::string_view line, char separator) {
  std::vector<Field> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = line.find(separator, begin);
    if (end == std::string_view::npos) break;
    fields.push_back(trimmed(line, begin, end));
    begin = end + 1;
  }
  fields.push_back(trimmed(line, begin, line.size()));
  return fields;
}

std::vector<Field> words_of(std::string_view line) {
  static constexpr std::string_view blanks = " \t";
  std::vector<Field> words;
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back({line.substr(at, end - at), static_cast<int>(at) + 1});
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

std::vector<Field> fields_of_row(std::string_view line) {
  const char separator = separator_of(line);
  return separator != '\t' && line.find(separator) != std::string_view::npos ? split(line, separator) : words_of(line);
}

NumberProblem read_number_field(const Field& field, std::string_view name, Real& value) {
  std::string_view text = field.text;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc{} || end != text.data() + text.size() || field.text.starts_with("+-"))
    return {fmt::format("{}: a number was expected, found \"{}\"", name, field.text), help_for(field.text)};
  if (std::isfinite(value)) return {};
  return {fmt::format("{} must be a finite number, found {}", name, field.text), "remove the row, or enter the intended number"};
}

std::optional<int> add_text_file(const std::filesystem::path& file, const std::string& shown_name, std::string_view what,
                                 const Place& named_at, Problems& problems) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  const std::string content = text.str();
  if (!stream) {
    problems.error(named_at, fmt::format("{} {} cannot be read", what, shown_name), "is it a text file?");
    return {};
  }
  if (content.find('\0') != std::string::npos) {
    problems.error(named_at, fmt::format("{} {} is not plain text: it has bytes of value 0", what, shown_name),
                   "save it as text in UTF-8; UTF-16 (\"Unicode text\" of spreadsheets) is not read");
    return {};
  }
  return problems.add_source(source_from_text(shown_name, plain_text(content)));
}

}  // namespace sazare::cases
