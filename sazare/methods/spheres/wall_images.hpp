#pragma once

/// Surfaces of triangles in a periodic domain, which go on beyond its sides.

#include <array>

#include "sazare/methods/spheres/wall.hpp"

namespace sazare::methods::spheres {

/// How a surface goes on beyond the sides of a domain across an axis.
struct WallSides {
  bool repeats = false;  ///< it needs periodic images: it does not reach beyond both sides by what spheres may touch there
  bool can = true;       ///< false where it is to, but turns out of its images
  Real gap = 0;          ///< between it and its image [m]; below 0 where they overlap
};

/// `reach`: how far beyond the sides of the domain triangles may be touched [m].
WallSides sides_of(const Wall& wall, const state::PeriodicBox& box, int axis, Real reach);

/// Adds to a surface its next images along those periodic axes beyond whose sides it does not reach, as far as they come within
/// the reach of the domain. To be called once, for a surface that can have periodic images, see `sides_of`. Returns along which
/// axes there are any.
std::array<bool, 3> repeat_wall(Wall& wall, const state::PeriodicBox& box, Real reach);

}  // namespace sazare::methods::spheres
