#pragma once

/// Pairs of spheres that step at several time levels, level by level.

#include <cstdint>
#include <span>

#include "sazare/neighbors/sphere_pairs.hpp"

namespace sazare::neighbors {

/// A pair has the finer level of its two spheres. The pace of a sphere is the finest level among its own and its pairs'. Spheres
/// are to be sorted by their pace, the finest first, and then along a curve: those of a pace or a finer one so come first.
struct LeveledPairs {
  std::vector<Index> order;          ///< the n-th is the sphere that should stand n-th
  std::vector<std::size_t> spheres;  ///< by level: so many have this pace or a finer one
  std::vector<SpherePairs> pairs;    ///< by level, of that many spheres, by the places they are to have
};

/// All pairs whose surfaces are nearer than the margin [m]; `level` by present place, at least one of each sphere, `finest` at
/// most.
LeveledPairs find_leveled_pairs(const state::Spheres& spheres, Real margin, std::span<const std::int8_t> level, int finest);

}  // namespace sazare::neighbors
