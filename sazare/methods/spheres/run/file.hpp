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

/// Rows of `count` numbers of a file; blank lines, those that begin with #, and titles in the first line are skipped. Throws
/// UserError with the line that is none.
std::vector<FileRow> read_rows(const std::filesystem::path& file, std::size_t count, const std::string& expected);

struct FileBall {
  std::size_t line = 0;
  geometry::Ball ball;
};

/// Rows of radius, x, y, z of a file. Throws UserError with the line that is none.
std::vector<FileBall> read_balls(const std::filesystem::path& file);

}  // namespace sazare::runs
