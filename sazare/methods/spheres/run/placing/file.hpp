#pragma once

/// Files of spheres: rows of numbers.

#include <filesystem>
#include <string>
#include <vector>

#include "sazare/geometry/ball_union.hpp"

namespace sazare::runs {

struct FileRow {
  std::size_t line = 0;  ///< counted from 1
  std::vector<Real> numbers;
};

/// What a row holds: the titles that each column may have, and what is said where a row is none.
struct RowFormat {
  std::vector<std::vector<std::string>> titles;
  std::string expected;
};

extern const RowFormat ball_rows;   ///< radius, x, y, z
extern const RowFormat place_rows;  ///< x, y, z and a rotation vector

/// Rows of numbers of a file, between blanks, commas or semicolons. Blank lines and those that begin with # are skipped; titles
/// may stand in the first line. Throws UserError for a line that is no row, for titles of other columns, and for units other than
/// m and rad.
std::vector<FileRow> read_rows(const std::filesystem::path& file, const RowFormat& format);

struct FileBall {
  std::size_t line = 0;
  geometry::Ball ball;
};

/// Rows of radius, x, y, z of a file. Throws UserError with the line that is none.
std::vector<FileBall> read_balls(const std::filesystem::path& file);

}  // namespace sazare::runs
