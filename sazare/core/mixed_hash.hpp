#pragma once

#include <cstdint>

namespace sazare {

/// Mixes a number into a hash so that every bit of it matters (the finalizer of SplitMix64).
constexpr std::uint64_t mixed_hash(std::uint64_t hash, std::uint64_t number) {
  hash += number + 0x9E3779B97F4A7C15ULL;
  hash = (hash ^ (hash >> 30)) * 0xBF58476D1CE4E5B9ULL;
  hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBULL;
  return hash ^ (hash >> 31);
}

}  // namespace sazare
