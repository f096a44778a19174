#pragma once

/// Surfaces of triangles that may close around a solid: their edges, and the mass properties of what they hold.

#include <span>

#include "sazare/geometry/ball_union.hpp"

namespace sazare::geometry {

/// Edges of a surface by how its triangles share them; corners are the same when they agree to the last digit.
struct SurfaceEdges {
  std::size_t open = 0;     ///< of one triangle
  std::size_t crowded = 0;  ///< of more than two
  std::size_t turned = 0;   ///< of two triangles that do not have the same side out

  /// Whether every edge belongs to two triangles.
  bool are_closed() const { return open == 0 && crowded == 0; }
};

SurfaceEdges edges_of(std::span<const Triangle> surface);

/// Volume, centre and inertia of the solid of density 1 within a closed surface, whose triangles all have the same side out:
/// exact, as sums over the tetrahedra between the triangles and a point.
UnionProperties properties_of_solid(std::span<const Triangle> surface);

}  // namespace sazare::geometry
