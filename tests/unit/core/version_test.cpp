#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "sazare/core/version.hpp"

namespace sazare {
namespace {

TEST(Version, HasThreeNumbers) {
  const std::string text = version;
  EXPECT_EQ(std::count(text.begin(), text.end(), '.'), 2) << text;
}

TEST(Version, NamesItsCommit) { EXPECT_FALSE(std::string(commit).empty()); }

}  // namespace
}  // namespace sazare
