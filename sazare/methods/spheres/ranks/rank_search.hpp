#pragma once

/// A search for pairs among spheres that several ranks share. No rank holds all of them: each knows its own and those near them.
/// The ranks sort the spheres together, give each its new tiles, and tell the others which of them are near theirs.

#include <cstdint>
#include <span>
#include <vector>

#include "sazare/methods/spheres/ranks/rank_tiles.hpp"
#include "sazare/neighbors/sphere_cells.hpp"

namespace sazare::methods::spheres {

class RankSearch {
public:
  /// Pairs are found whose surfaces are nearer than the margin [m]. `level`: by number of the sphere, `finest` at most; empty where
  /// all are at one time level. All call it, and all that is below.
  RankSearch(RankTiles& ranks, state::Spheres& spheres, Real margin, std::span<const std::int8_t> level, int finest);

  /// Where own spheres, and those of others at which own tiles look, come to stand, by their places now; of others it says nothing.
  std::vector<Index> new_places();
  /// Ranks take over new tiles: each comes to know the spheres of its own and those near them.
  void move();
  /// The pairs of own tiles, by time level; to be called after `move`.
  std::vector<neighbors::SpherePairs> pairs() const;

private:
  void know_nearby() const;
  std::vector<std::int8_t> active_levels() const;
  std::vector<std::int8_t> levels_of(const std::vector<Index>& known) const;
  std::size_t finest() const { return static_cast<std::size_t>(finest_); }

  RankTiles* ranks_;
  state::Spheres* spheres_;
  Real margin_;
  std::span<const std::int8_t> level_;
  int finest_;
  neighbors::SphereSizes sizes_;
  std::vector<std::size_t> of_level_;  ///< by level: so many spheres of all ranks have this active level or a finer one
  std::vector<Index> places_;          ///< new ones of own spheres, in their order
};

}  // namespace sazare::methods::spheres
