#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <random>

#include "sazare/cases/format/number_text.hpp"

namespace sazare::cases {
namespace {

TEST(NumberText, IsShortAndInEngineeringForm) {
  EXPECT_EQ(number_text(0), "0.0");
  EXPECT_EQ(number_text(2390), "2390.0");
  EXPECT_EQ(number_text(0.58), "0.58");
  EXPECT_EQ(number_text(-0.001), "-0.001");
  EXPECT_EQ(number_text(450e9), "450e9");
  EXPECT_EQ(number_text(6.66e6), "6.66e6");
  EXPECT_EQ(number_text(1.33e-4), "133e-6");
  EXPECT_EQ(number_text(-1e-8), "-10e-9");
  EXPECT_EQ(number_text(std::numeric_limits<Real>::infinity()), "inf");
  EXPECT_EQ(short_number(2390), "2390");
  EXPECT_EQ(short_number(1.0 / 3, 3), "0.333");
  EXPECT_EQ(short_number(999999.9, 4), "1e6");
}

TEST(NumberText, ReadsBackExactly) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<Real> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int i = 0; i < 2000; ++i) {
    const Real value = mantissa(random) * std::pow(10.0, exponent(random));
    EXPECT_EQ(std::strtod(number_text(value).c_str(), nullptr), value) << number_text(value);
  }
}

TEST(StringText, EscapesWhatTomlNeeds) {
  EXPECT_EQ(string_text("plain 発破"), "\"plain 発破\"");
  EXPECT_EQ(string_text("a\"b\\c\nd"), "\"a\\\"b\\\\c\\u000ad\"");
}

}  // namespace
}  // namespace sazare::cases
