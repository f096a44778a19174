#include "sazare/methods/spheres/run/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include "sazare/core/error.hpp"

namespace sazare::runs {

std::vector<FileRow> read_rows(const std::filesystem::path& file, std::size_t count, const std::string& expected) {
  std::ifstream stream(file);
  if (!stream) throw UserError(fmt::format("{}: the file of spheres cannot be read", file.string()));
  std::vector<FileRow> rows;
  std::string line;
  bool may_be_titles = true;  // of the columns, in the first line that is not empty
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    std::ranges::replace(line, ',', ' ');
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    if (std::exchange(may_be_titles, false) && std::isalpha(static_cast<unsigned char>(line[begin])) != 0) continue;
    std::istringstream words(line);
    std::vector<Real> row(count);
    bool good = std::ranges::all_of(row, [&](Real& value) { return static_cast<bool>(words >> value); });
    std::string rest;
    good = good && !(words >> rest);
    if (!good) throw UserError(fmt::format("{}:{}: {}, found \"{}\"", file.string(), number, expected, line));
    rows.push_back({number, std::move(row)});
  }
  return rows;
}

std::vector<FileBall> read_balls(const std::filesystem::path& file) {
  std::vector<FileBall> balls;
  for (const auto& [line, row] : read_rows(file, 4, "four numbers were expected, radius, x, y and z in m")) {
    balls.push_back({line, {{row[1], row[2], row[3]}, row[0]}});
    const geometry::Ball& ball = balls.back().ball;
    if (!(ball.radius > 0) || !std::isfinite(ball.radius) || !ball.centre.allFinite())
      throw UserError(fmt::format("{}:{}: a radius greater than 0 and a finite centre were expected, found {} at ({}, {}, {})",
                                  file.string(), line, row[0], row[1], row[2], row[3]));
  }
  return balls;
}

}  // namespace sazare::runs
