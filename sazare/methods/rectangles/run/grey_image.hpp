#pragma once

#include <filesystem>
#include <vector>

namespace sazare::runs {

/// A grey image, row by row from the top.
struct GreyImage {
  int width = 0, height = 0, white = 255;
  std::vector<int> grey;

  int at(int column, int row) const { return grey[static_cast<std::size_t>(row * width + column)]; }
};

/// Reads a PGM file, plain (P2) or of one byte per pixel (P5). Throws UserError saying what is wrong with it.
GreyImage read_grey_image(const std::filesystem::path& file);

}  // namespace sazare::runs
