#pragma once

/// Where tiles are cut into shares of threads: share s has the tiles cuts[s] .. cuts[s + 1] - 1.

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "sazare/core/time.hpp"

namespace sazare::methods::spheres {

/// As many tiles for each, but one.
inline std::vector<std::size_t> even_cuts(std::size_t tiles, std::size_t shares) {
  shares = std::clamp<std::size_t>(shares, 1, std::max<std::size_t>(tiles, 1));
  std::vector<std::size_t> cuts;
  for (std::size_t share = 0; share <= shares; ++share) cuts.push_back(tiles * share / shares);
  return cuts;
}

/// As much work for each, where every tile costs so much.
inline std::vector<std::size_t> balanced_cuts(std::span<const Real> costs, std::size_t shares) {
  std::vector<std::size_t> cuts = even_cuts(costs.size(), shares);
  const Real all = std::accumulate(costs.begin(), costs.end(), Real{0});
  if (!(all > 0)) return cuts;
  Real passed = 0;
  std::size_t next = 1;
  for (std::size_t tile = 0; tile < costs.size(); ++tile) {
    passed += costs[tile];
    for (; next < shares && passed - 0.5 * costs[tile] > all * static_cast<Real>(next) / static_cast<Real>(shares); ++next)
      cuts[next] = tile;
  }
  for (; next < shares; ++next) cuts[next] = costs.size();
  for (std::size_t n = 1; n < shares; ++n)  // no share without a tile
    cuts[n] = std::clamp(cuts[n], cuts[n - 1] + 1, costs.size() - (shares - n));
  return cuts;
}

/// What tiles cost, learnt from what shares take. Single measurements differ by more than shares should, so that each counts
/// for a part alone.
class TileCosts {
public:
  std::size_t tiles() const { return costs_.size(); }

  /// Shares cut like this took so many seconds.
  void learn(const std::vector<std::size_t>& cuts, std::span<const Real> seconds) {
    const bool is_first = tiles() != cuts.back();
    if (is_first) costs_.assign(cuts.back(), 0);
    const Real weight = is_first ? 1 : 0.5;
    for (std::size_t share = 0; share < seconds.size(); ++share) {
      const Real each = seconds[share] / static_cast<Real>(std::max<std::size_t>(cuts[share + 1] - cuts[share], 1));
      for (std::size_t tile = cuts[share]; tile < cuts[share + 1]; ++tile) costs_[tile] += weight * (each - costs_[tile]);
    }
  }

  /// Better cuts, or the same where no others are better by more than cutting is worth.
  std::vector<std::size_t> improved(const std::vector<std::size_t>& cuts) const {
    constexpr Real worth = 0.02;
    std::vector<std::size_t> better = balanced_cuts(costs_, cuts.size() - 1);
    return dearest(better) < (1 - worth) * dearest(cuts) ? better : cuts;
  }

private:
  Real dearest(const std::vector<std::size_t>& cuts) const {
    Real most = 0;
    for (std::size_t share = 0; share + 1 < cuts.size(); ++share)
      most = std::max(most, std::accumulate(costs_.begin() + static_cast<std::ptrdiff_t>(cuts[share]),
                                            costs_.begin() + static_cast<std::ptrdiff_t>(cuts[share + 1]), Real{0}));
    return most;
  }

  std::vector<Real> costs_;  ///< by tile, of some steps [s]
};

}  // namespace sazare::methods::spheres
