#include "sazare/methods/spheres/run/placing/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

#include "sazare/cases/format/csv_fields.hpp"
#include "sazare/core/error.hpp"
#include "sazare/core/plain_text.hpp"

namespace sazare::runs {

namespace {

/// The lines of a text file.
std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw UserError(fmt::format("{}: the file of spheres cannot be read", file.string()));
  std::ostringstream content;
  content << stream.rdbuf();
  const std::string text = plain_text(content.str());
  if (text.find('\0') != std::string::npos)
    throw UserError(fmt::format("{}: the file of spheres is not plain text: save it as text in UTF-8", file.string()));
  return cases::source_from_text(file.string(), text).lines;
}

/// Words of a line of titles or of a comment, in lower case, with units apart: "Radius[mm]" is "radius" and "[mm]".
std::vector<std::string> title_words(std::string_view line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    const bool separates = std::string_view(" \t,;:\"").find(c) != std::string_view::npos;
    const bool opens = c == '[' || c == '(', closes = c == ']' || c == ')';
    if ((separates || opens) && !words.back().empty()) words.emplace_back();
    if (opens || closes) words.back() += opens ? '[' : ']';
    if (!separates && !opens && !closes) words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (closes) words.emplace_back();
  }
  std::erase_if(words, [](const std::string& word) { return word.empty(); });
  return words;
}

/// A unit in brackets that is neither m nor rad, though numbers are read in these; nothing where there is none.
std::string foreign_unit(const std::vector<std::string>& words) {
  static constexpr std::array foreign{"[mm]", "[cm]", "[dm]", "[km]", "[um]", "[in]", "[inch]", "[ft]", "[deg]", "[degrees]"};
  for (const std::string& word : words)
    if (std::ranges::find(foreign, word) != foreign.end()) return word.substr(1, word.size() - 2);
  return "";
}

/// Titles must be those of the columns, in their order; units in brackets may stand beside them.
void check_titles(const std::filesystem::path& file, std::size_t number, const std::vector<std::string>& words,
                  const RowFormat& format) {
  std::vector<std::string> names;
  for (const std::string& word : words)
    if (!word.starts_with('[')) names.push_back(word);
  const bool good =
      names.size() == format.titles.size() && std::ranges::equal(names, format.titles, [](const auto& name, const auto& titles) {
        return std::ranges::find(titles, name) != titles.end();
      });
  if (good) return;
  std::vector<std::string> expected;
  for (const auto& titles : format.titles) expected.push_back(titles.front());
  throw UserError(fmt::format("{}:{}: {}; the titles of their columns are {}; begin other lines with #", file.string(), number,
                              format.expected, fmt::join(expected, ", ")));
}

void check_units(const std::filesystem::path& file, std::size_t number, const std::vector<std::string>& words) {
  const std::string unit = foreign_unit(words);
  if (!unit.empty())
    throw UserError(fmt::format("{}:{}: the file says [{}], but lengths are read in m and angles in rad: convert the numbers",
                                file.string(), number, unit));
}

/// Says which number of a row is none, or that there are too few or too many.
[[noreturn]] void refuse_row(const std::filesystem::path& file, std::size_t number, const std::string& line,
                             const std::vector<cases::Field>& fields, const RowFormat& format) {
  if (fields.size() == format.titles.size())
    for (std::size_t n = 0; n < fields.size(); ++n) {
      Real value = 0;
      const cases::NumberProblem problem = cases::read_number_field(fields[n], format.titles[n].front(), value);
      if (!problem.what.empty())
        throw UserError(fmt::format("{}:{}:{}: {}", file.string(), number, fields[n].column, problem.what));
    }
  throw UserError(fmt::format("{}:{}: {}, found {} in \"{}\"", file.string(), number, format.expected, fields.size(), line));
}

}  // namespace

std::vector<FileRow> read_rows(const std::filesystem::path& file, const RowFormat& format) {
  const std::vector<std::string> lines = lines_of(file);
  std::vector<FileRow> rows;
  bool may_be_titles = true;  // of the columns, in the first line that is neither empty nor a comment
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    const auto begin = line.find_first_not_of(" \t");
    if (begin == std::string::npos) continue;
    if (line[begin] == '#') {
      if (rows.empty()) check_units(file, i + 1, title_words(line));
      continue;
    }
    const std::vector<cases::Field> fields = cases::fields_of_row(line);
    FileRow row{i + 1, std::vector<Real>(format.titles.size())};
    const bool is_row =
        fields.size() == row.numbers.size() && std::ranges::equal(fields, row.numbers, [](const auto& field, Real& value) {
          return cases::read_number_field(field, "", value).what.empty();
        });
    const bool is_title =
        std::exchange(may_be_titles, false) && std::string_view("+-.0123456789").find(line[begin]) == std::string_view::npos;
    if (is_title) {
      check_titles(file, i + 1, title_words(line), format);
      check_units(file, i + 1, title_words(line));
    } else if (!is_row) {
      refuse_row(file, i + 1, line, fields, format);
    } else {
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

const RowFormat ball_rows{{{"radius", "r"}, {"x"}, {"y"}, {"z"}}, "four numbers were expected, radius, x, y and z in m"};

const RowFormat place_rows{{{"x"}, {"y"}, {"z"}, {"rx", "rotation_x"}, {"ry", "rotation_y"}, {"rz", "rotation_z"}},
                           "six numbers were expected, x, y, z in m and a rotation vector in rad"};

std::vector<FileBall> read_balls(const std::filesystem::path& file) {
  std::vector<FileBall> balls;
  for (const auto& [line, row] : read_rows(file, ball_rows)) {
    balls.push_back({line, {{row[1], row[2], row[3]}, row[0]}});
    const geometry::Ball& ball = balls.back().ball;
    if (!(ball.radius > 0) || !std::isfinite(ball.radius) || !ball.centre.allFinite())
      throw UserError(fmt::format("{}:{}: a radius greater than 0 and a finite centre were expected, found {} at ({}, {}, {})",
                                  file.string(), line, row[0], row[1], row[2], row[3]));
  }
  return balls;
}

}  // namespace sazare::runs
