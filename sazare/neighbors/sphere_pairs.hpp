#pragma once

/// Pairs of spheres that may touch before anything has moved by more than a margin, and an order of spheres in which neighbours
/// stand near each other. Spheres of any sizes: each size class (a factor of two) has its own grid of cells.

#include <cstdint>
#include <span>
#include <vector>

#include "sazare/state/spheres.hpp"

namespace sazare::neighbors {

/// Spheres are worked on by tiles of so many, whatever the number of threads.
inline constexpr std::size_t tile_size = 1024;
/// How many tiles so many spheres fill, the last one in part.
inline constexpr std::size_t tiles_of(std::size_t spheres) { return (spheres + tile_size - 1) / tile_size; }

/// Pairs by their first sphere: those of sphere i are other[first[i]] .. other[first[i + 1] - 1], all beyond i.
struct SpherePairs {
  std::vector<std::uint32_t> first;
  std::vector<Index> other;
};

struct SphereSizes;
class CellGrid;

/// The grid whose cells give spheres of such sizes their order.
CellGrid order_grid(const state::PeriodicBox& box, const SphereSizes& sizes, Real margin);

/// The order of their cells, see CellOrder: the n-th is the sphere that should stand n-th.
std::vector<Index> order_by_cell(const state::Spheres& spheres, Real margin);

/// Where each sphere stands when the n-th has become what `order[n]` was.
std::vector<Index> places_after(const std::vector<Index>& order);

/// Sorts spheres: the n-th becomes what `order[n]` was.
void put_in_order(state::Spheres& spheres, const std::vector<Index>& order);

/// Drops the pairs whose first sphere is in a tile that is not wanted.
void keep_wanted(SpherePairs& pairs, std::span<const std::uint8_t> is_wanted);

/// All pairs whose surfaces are nearer than the margin [m]. Each pair once, by the nearest image in a periodic box. Where
/// `is_wanted` is given, by tile, those alone whose first sphere is in a wanted tile.
SpherePairs find_pairs(const state::Spheres& spheres, Real margin, std::span<const std::uint8_t> is_wanted = {});

/// What one of several processes knows of the spheres.
struct KnownSpheres {
  const SphereSizes& sizes;       ///< of all spheres
  std::span<const Index> places;  ///< of those it knows, in order
};
/// Those of pairs of known spheres. Where all within the margin of a wanted tile are known, these are the pairs of the wanted
/// tiles that would be found among all spheres, in the same order.
SpherePairs find_pairs(const state::Spheres& spheres, Real margin, std::span<const std::uint8_t> is_wanted,
                       const KnownSpheres& known);

}  // namespace sazare::neighbors
