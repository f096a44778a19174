#include "sazare/methods/rectangles/run/grey_image.hpp"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <string>

#include "sazare/core/error.hpp"

namespace sazare::runs {

namespace {

constexpr int most_pixels_across = 20000;

/// The next whole number of a header; comments go from # to the end of the line.
int next_number(std::istream& stream, const std::filesystem::path& file, const char* what) {
  while (stream >> std::ws && stream.peek() == '#') stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  int number = 0;
  if (!(stream >> number)) throw UserError(fmt::format("{}: the {} of the image is missing", file.string(), what));
  return number;
}

}  // namespace

GreyImage read_grey_image(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string kind;
  stream >> kind;
  if (kind != "P2" && kind != "P5")
    throw UserError(fmt::format("{}: not a grey-scale image: it should begin with P2 or P5 (.pgm)", file.string()));
  GreyImage image;
  image.width = next_number(stream, file, "width");
  image.height = next_number(stream, file, "height");
  image.white = next_number(stream, file, "largest grey");
  if (image.width < 1 || image.height < 1 || image.width > most_pixels_across || image.height > most_pixels_across ||
      image.white < 1 || image.white > 255)
    throw UserError(
        fmt::format("{}: an image of {} x {} pixels with greys to {}: each side must be from 1 to {}, greys at most 255",
                    file.string(), image.width, image.height, image.white, most_pixels_across));
  stream.get();
  image.grey.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (int& grey : image.grey) {
    if (kind == "P2")
      stream >> grey;
    else
      grey = stream.get();
    if (!stream)
      throw UserError(fmt::format("{}: the image ends before its {} x {} pixels", file.string(), image.width, image.height));
  }
  return image;
}

}  // namespace sazare::runs
