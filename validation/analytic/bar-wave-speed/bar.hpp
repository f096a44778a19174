#pragma once

/// A square bar of 2 x 2 x n cubes, each a regular tetrahedron and four corners round it; neighbouring cubes are mirror
/// images, so that the bar is symmetric about its two middle planes and pulling it does not bend or twist it.

#include <array>
#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::validation {

inline constexpr Real cube_size = 0.05;  // [m]
inline constexpr int cubes_along = 40;
inline constexpr Real bar_length = cubes_along * cube_size;
inline constexpr Real bar_width = 2 * cube_size;

/// Whether the four sides along the bar are free, or slide along frictionless ground.
enum class Sides { free, confined };

/// Along x, its axis in y = z = 0. The four sides are the surface "sides".
geometry::TetraMesh bar_mesh();

/// Springs of the blasting paper, without dashpots, that cannot break.
cases::BlocksCase bar_case(Sides sides);

}  // namespace sazare::validation
