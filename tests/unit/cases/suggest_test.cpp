#include <gtest/gtest.h>

#include <vector>

#include "sazare/cases/format/suggest.hpp"

namespace sazare::cases {
namespace {

TEST(EditDistance, CountsEdits) {
  EXPECT_EQ(edit_distance("", ""), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("abc", ""), 3);
  EXPECT_EQ(edit_distance("density", "density"), 0);
  EXPECT_EQ(edit_distance("densty", "density"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

TEST(EditDistance, CountsASwapOfNeighboursOnce) {
  EXPECT_EQ(edit_distance("ned", "end"), 1);
  EXPECT_EQ(edit_distance("cohseion", "cohesion"), 1);
}

TEST(EditDistance, IsSymmetric) {
  const std::vector<std::string> words{"time", "tiem", "", "stiffness", "stffnes", "x"};
  for (const auto& a : words)
    for (const auto& b : words) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a)) << a << " " << b;
}

TEST(NearestWord, IgnoresCaseAndFarWords) {
  const std::vector<std::string> words{"density", "name", "regions"};
  EXPECT_EQ(nearest_word("Density", words), "density");
  EXPECT_EQ(nearest_word("region", words), "regions");
  EXPECT_EQ(nearest_word("colour", words), "");
  EXPECT_EQ(nearest_word("", words), "");
}

TEST(NearestWord, FindsAWordThatIsLeftIncomplete) {
  const std::vector<std::string> words{"friction_coefficient", "normal_stiffness"};
  EXPECT_EQ(nearest_word("friction", words), "friction_coefficient");
  EXPECT_EQ(nearest_word("stiffness", words), "normal_stiffness");
}

TEST(Suggestion, NamesTheNearestOrAll) {
  const std::vector<std::string> words{"hole", "left"};
  EXPECT_EQ(suggestion("holes", words, "surfaces"), "did you mean \"hole\"?");
  EXPECT_EQ(suggestion("bottom", words, "surfaces"), "the surfaces are \"hole\" and \"left\"");
  EXPECT_EQ(suggestion("bottom", {}, "surfaces"), "there are no surfaces");
  EXPECT_EQ(full_suggestion("holes", words, "surfaces"), "did you mean \"hole\"? the surfaces are \"hole\" and \"left\"");
}

}  // namespace
}  // namespace sazare::cases
