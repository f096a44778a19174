#pragma once

#include <cstdint>

#include "sazare/core/vector.hpp"

namespace sazare {

/// Random numbers that are the same on every machine: Knuth's linear congruential generator of 64 bits, its upper 53.
class Random {
public:
  explicit Random(int seed) : state_(static_cast<std::uint64_t>(seed) * 0x9E3779B97F4A7C15ULL) {}

  Real between(Real low, Real high) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * static_cast<Real>(state_ >> 11) / 9007199254740992.0;
  }

private:
  std::uint64_t state_;
};

}  // namespace sazare
