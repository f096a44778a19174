#include "sazare/core/morton.hpp"

#include <gtest/gtest.h>

namespace sazare {
namespace {

/// Bit by bit: `bits` of them, `axes` places from each other.
std::uint64_t apart(std::uint64_t number, int bits, int axes) {
  std::uint64_t spread = 0;
  for (int bit = 0; bit < bits; ++bit) spread |= (number >> bit & 1) << (axes * bit);
  return spread;
}

TEST(morton, sets_bits_apart) {
  std::uint64_t number = 1;
  for (int n = 0; n < 1000; ++n, number = number * 6364136223846793005ULL + 1442695040888963407ULL) {
    EXPECT_EQ(spread_for_two(number), apart(number, 32, 2));
    EXPECT_EQ(spread_for_three(number), apart(number, 21, 3));
  }
}

}  // namespace
}  // namespace sazare
