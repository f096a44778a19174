#include "sazare/methods/rectangles/run/grey_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "sazare/core/error.hpp"
#include "sazare/core/plain_text.hpp"

namespace sazare::runs {

namespace {

constexpr int most_pixels_across = 20000;

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  if (!stream) throw UserError(fmt::format("{}: the image cannot be read", file.string()));
  return bytes.str();
}

class ImageReader {
public:
  ImageReader(const std::filesystem::path& file, std::string_view bytes) : file_(file), rest_(without_byte_order_mark(bytes)) {}

  GreyImage read() {
    const std::string_view kind = next_word();
    if (kind != "P2" && kind != "P5") fail("not a grey-scale image: it should begin with P2 or P5 (.pgm)");
    image_.width = next_number("the width of the image");
    image_.height = next_number("the height of the image");
    image_.white = next_number("the largest grey of the image");
    if (image_.width < 1 || image_.height < 1 || image_.width > most_pixels_across || image_.height > most_pixels_across ||
        image_.white < 1 || image_.white > 255)
      fail(fmt::format("an image of {} x {} pixels with greys to {}: each side must be from 1 to {}, greys at most 255",
                       image_.width, image_.height, image_.white, most_pixels_across));
    kind == "P2" ? read_text() : read_binary();
    return std::move(image_);
  }

private:
  static constexpr std::string_view blanks = " \t\r\n\v\f";

  std::size_t pixels() const { return static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height); }

  [[noreturn]] void fail(const std::string& what) const { throw UserError(fmt::format("{}: {}", file_.string(), what)); }
  [[noreturn]] void fail_short() const {
    fail(fmt::format("the image ends before its {} x {} pixels", image_.width, image_.height));
  }

  /// Empty at the end; comments go from # to the end of the line.
  std::string_view next_word() {
    while (true) {
      rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
      if (!rest_.starts_with('#')) break;
      rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
    }
    const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
    rest_.remove_prefix(word.size());
    return word;
  }

  int next_number(std::string_view what) {
    const std::string_view word = next_word();
    if (word.empty()) fail(fmt::format("{} is missing", what));
    int number = 0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (failure != std::errc{} || end != word.data() + word.size())
      fail(fmt::format("{}: a whole number was expected, found \"{}\"", what, word.substr(0, 40)));
    return number;
  }

  void add(int grey) {
    if (grey < 0 || grey > image_.white)
      fail(fmt::format("pixel {} of row {} has the grey {}, but greys go from 0 to {}",
                       image_.grey.size() % static_cast<std::size_t>(image_.width) + 1,
                       image_.grey.size() / static_cast<std::size_t>(image_.width) + 1, grey, image_.white));
    image_.grey.push_back(grey);
  }

  void read_text() {
    if (rest_.size() < 2 * pixels()) fail_short();  // a blank and a digit each
    image_.grey.reserve(pixels());
    while (image_.grey.size() < pixels()) {
      rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
      if (rest_.empty()) fail_short();
      add(next_number("a grey"));
    }
    if (!next_word().empty())
      fail(fmt::format("more follows after the {} x {} pixels of the image", image_.width, image_.height));
  }

  /// One blank parts head and pixels, or the two characters that end a line on some systems.
  void read_binary() {
    if (rest_.empty() || blanks.find(rest_.front()) == std::string_view::npos) fail_short();
    const std::size_t size = pixels();
    if (rest_.starts_with("\r\n") && rest_.size() == size + 2) rest_.remove_prefix(1);
    rest_.remove_prefix(1);
    if (rest_.size() < size) fail_short();
    if (rest_.size() > size)
      fail(fmt::format(
          "{} bytes follow after the {} x {} pixels of the image: one blank separates header and pixels, and nothing follows",
          rest_.size() - size, image_.width, image_.height));
    image_.grey.reserve(size);
    for (const char grey : rest_) add(static_cast<unsigned char>(grey));
  }

  const std::filesystem::path& file_;
  std::string_view rest_;
  GreyImage image_;
};

}  // namespace

GreyImage read_grey_image(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file);
  return ImageReader(file, bytes).read();
}

}  // namespace sazare::runs
