#pragma once

/// Bits of numbers set apart, so that those of others fit between them: places along a Morton curve.

#include <cstdint>

namespace sazare {

/// The lower 32 bits of a number, with a free place after each: for two axes.
inline std::uint64_t spread_for_two(std::uint64_t number) {
  number &= 0x00000000ffffffffULL;
  number = (number | number << 16) & 0x0000ffff0000ffffULL;
  number = (number | number << 8) & 0x00ff00ff00ff00ffULL;
  number = (number | number << 4) & 0x0f0f0f0f0f0f0f0fULL;
  number = (number | number << 2) & 0x3333333333333333ULL;
  return (number | number << 1) & 0x5555555555555555ULL;
}

/// The lower 21 bits of a number, with two free places after each: for three axes.
inline std::uint64_t spread_for_three(std::uint64_t number) {
  number &= 0x00000000001fffffULL;
  number = (number | number << 32) & 0x001f00000000ffffULL;
  number = (number | number << 16) & 0x001f0000ff0000ffULL;
  number = (number | number << 8) & 0x100f00f00f00f00fULL;
  number = (number | number << 4) & 0x10c30c30c30c30c3ULL;
  return (number | number << 2) & 0x1249249249249249ULL;
}

}  // namespace sazare
