#pragma once

/// Pairs of spheres that step at several time levels, level by level.

#include <cstdint>
#include <span>
#include <vector>

#include "sazare/neighbors/sphere_pairs.hpp"

namespace sazare::neighbors {

/// A pair has the finer level of its two spheres. The active level of a sphere is the finest one among its own, its pairs' and
/// its bonds'. Spheres are to be sorted by their active level, the finest first, and then along a curve: so those of an active
/// level or a finer one come first.
struct LeveledPairs {
  std::vector<Index> order;          ///< the n-th is the sphere that should stand n-th
  std::vector<std::size_t> spheres;  ///< by level: so many have this active level or a finer one
  std::vector<SpherePairs> pairs;    ///< by level, of that many spheres, by the places they are to have
};

/// Time levels of spheres, all by present place.
struct LevelsByPlace {
  std::span<const std::int8_t> level;
  int finest = 0;  ///< level at most
  /// Two spheres that act on each other however far apart they are.
  struct Bonded {
    Index one = 0, other = 0;
  };
  std::vector<Bonded> bonded = {};
  std::vector<Index> body = {};  ///< spheres of one body have one active level; below 0 those of none; empty where all are
};

/// By place: the finest level among a sphere's own, its pairs' and its bonds', and of its body.
std::vector<std::int8_t> active_levels_of(const SpherePairs& pairs, const LevelsByPlace& levels);

/// The pairs of each level. `level` is by place, `spheres` as above: of so many are those of each level.
std::vector<SpherePairs> split_by_level(const SpherePairs& all, std::span<const std::int8_t> level,
                                        const std::vector<std::size_t>& spheres);

/// All pairs whose surfaces are nearer than the margin [m].
LeveledPairs find_leveled_pairs(const state::Spheres& spheres, Real margin, const LevelsByPlace& levels);

}  // namespace sazare::neighbors
