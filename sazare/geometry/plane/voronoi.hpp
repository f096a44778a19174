#pragma once

/// Irregular packings: nuclei without a preferred direction, and the cells around nuclei.

#include <span>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/geometry/plane/polygon.hpp"

namespace sazare::geometry {

/// All that is nearer to a nucleus than to any other, within an outline: a convex polygon.
struct VoronoiCell {
  static constexpr Index outside = -1;

  std::vector<Vector2> corners;  ///< counter-clockwise [m]
  std::vector<Index> beyond;     ///< by side, from its corner to the next: the nucleus behind it, or `outside`
};

/// The cell of each nucleus, cut out of a convex outline by the middle lines to the nuclei near it. Sides shorter than 1e-6 of a
/// cell are left out. The nuclei lie inside and apart from one another.
std::vector<VoronoiCell> voronoi_cells(std::span<const Vector2> nuclei, std::span<const Vector2> outline);

/// Nuclei in a convex outline, as many as squares of side `spacing` [m] have room, the same for the same seed: random places no
/// nearer than 0.6 of a spacing, then moved four times to the centroids of their cells (Lloyd 1982), which evens the cells out
/// and gives them no direction. They follow one another along a Morton curve.
std::vector<Vector2> scatter_nuclei(std::span<const Vector2> outline, Real spacing, int seed);

/// Puts places that are near in the plane near in memory: along a Morton curve of squares of side `spacing` [m].
void sort_along_curve(std::vector<Vector2>& places, Real spacing);

}  // namespace sazare::geometry
