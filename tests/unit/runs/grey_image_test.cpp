#include "sazare/methods/rectangles/run/grey_image.hpp"

#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

using test::TemporaryFolder;

std::vector<int> greys(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_grey_image(folder.write("a.pgm", bytes)).grey;
}

std::string words(const std::string& bytes) {
  return test::words_of<UserError>([&] { greys(bytes); });
}

#define EXPECT_SAYS(words, part) EXPECT_NE((words).find(part), std::string::npos) << (words)

TEST(grey_image, lines_may_end_as_on_any_system) {
  const std::vector<int> right = {1, 2, 3, 4};
  const std::string pixels = "\1\2\3\4";
  for (const char* end : {"\n", "\r\n", "\r", " "}) {
    EXPECT_EQ(greys(std::string("P5") + end + "2 2" + end + "255" + end + pixels), right);
    EXPECT_EQ(greys(std::string("P2") + end + "2 2" + end + "9" + end + "1 2" + end + "3 4" + end), right);
  }
  EXPECT_EQ(greys("P2\r# a comment\r2 2 9\r1 2 3 4"), right);
  EXPECT_EQ(greys(std::string("P5 2 2 255\n") + "\n\n\n\n"), std::vector<int>(4, 10)) << "pixels that look like line ends";
}

TEST(grey_image, says_what_does_not_fit_its_head) {
  EXPECT_SAYS(words("P5\n2 2\n255\n\1\2\3"), "the image ends before its 2 x 2 pixels");
  EXPECT_SAYS(words("P5\n2 2\n255\n\1\2\3\4\5"), "1 bytes follow after the 2 x 2 pixels");
  EXPECT_SAYS(words("P5\r\n2 2\r\n255\r\n\1\2\3\4\5"), "bytes follow after the 2 x 2 pixels");
  EXPECT_SAYS(words("P2\n2 2\n9\n1 2 3 4 5\n"), "more follows after the 2 x 2 pixels");
  EXPECT_SAYS(words("P2\n2 2\n9\n1 2 10 4\n"), "pixel 1 of row 2 has the grey 10, but greys go from 0 to 9");
  EXPECT_SAYS(words("P2\n2 2\n9\n1 -2 3 4\n"), "pixel 2 of row 1 has the grey -2");
  EXPECT_SAYS(words("P5\n2 1\n9\n\1\12"), "has the grey 10");
  EXPECT_SAYS(words("P2\n2 2\n9\n1 2.5 3 4\n"), "a whole number was expected, found \"2.5\"");
  EXPECT_SAYS(words("P5\n2x 2\n9\n"), "the width of the image: a whole number was expected");
  EXPECT_SAYS(words("P5\n20000 20000\n255\nx"), "the image ends before");
  EXPECT_SAYS(words("P6\n2 2\n255\n"), "not a grey-scale image");
}

}  // namespace
}  // namespace sazare::runs
