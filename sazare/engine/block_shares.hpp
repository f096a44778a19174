#pragma once

/// Where blocks are cut into shares of threads: share s has the blocks cuts[s] .. cuts[s + 1] - 1.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sazare/core/time.hpp"

namespace sazare::engine {

/// As many blocks for each, but one.
inline std::vector<std::size_t> even_cuts(std::size_t blocks, std::size_t shares) {
  shares = std::clamp<std::size_t>(shares, 1, std::max<std::size_t>(blocks, 1));
  std::vector<std::size_t> cuts;
  for (std::size_t share = 0; share <= shares; ++share) cuts.push_back(blocks * share / shares);
  return cuts;
}

/// As much work for each, where shares cut like `cuts` took so many seconds.
inline std::vector<std::size_t> balanced_cuts(const std::vector<std::size_t>& cuts, std::span<const Real> seconds) {
  std::vector<std::size_t> balanced = cuts;
  const std::size_t shares = cuts.size() - 1;
  Real all = 0, passed = 0;
  for (const Real one : seconds) all += one;
  std::size_t next = 1;
  for (std::size_t share = 0; share < shares; ++share) {
    const Real each = seconds[share] / static_cast<Real>(cuts[share + 1] - cuts[share]);
    for (std::size_t block = cuts[share]; block < cuts[share + 1]; ++block) {
      passed += each;
      for (; next < shares && passed - 0.5 * each > all * static_cast<Real>(next) / static_cast<Real>(shares); ++next)
        balanced[next] = block;
    }
  }
  for (std::size_t n = 1; n < shares; ++n)  // no share without a block
    balanced[n] = std::clamp(balanced[n], balanced[n - 1] + 1, cuts.back() - (shares - n));
  return balanced;
}

}  // namespace sazare::engine
