#include "sazare/core/saturated.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace sazare {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();

TEST(Saturated, CutsOffTheFractionOfWhatFits) {
  EXPECT_EQ(saturated<int>(2.9), 2);
  EXPECT_EQ(saturated<int>(-2.9), -2);
  EXPECT_EQ(saturated<std::int64_t>(1e15), 1'000'000'000'000'000);
  EXPECT_EQ(saturated<std::int64_t>(std::ldexp(-1.0, 63)), std::numeric_limits<std::int64_t>::min());
}

TEST(Saturated, GivesTheNearestIntegerOfWhatDoesNot) {
  EXPECT_EQ(saturated<int>(2147483648.0), 2147483647);
  EXPECT_EQ(saturated<std::int64_t>(std::ldexp(1.0, 63)), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(saturated<std::int64_t>(1e300), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(saturated<std::int64_t>(-infinity), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(saturated<std::uint64_t>(infinity), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(saturated<std::uint64_t>(-1), 0u);
}

TEST(Saturated, GivesZeroForWhatIsNoNumber) { EXPECT_EQ(saturated<std::int64_t>(std::numeric_limits<Real>::quiet_NaN()), 0); }

}  // namespace
}  // namespace sazare
