#pragma once

/// Polygons in the plane by their corners, counter-clockwise, the first not repeated.

#include <span>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::geometry {

using Vector2 = Vector<2>;

struct PolygonMeasures {
  Real area = 0;                       ///< [m2]; negative where the corners run clockwise
  Vector2 centroid = Vector2::Zero();  ///< [m]
  Real second_moment = 0;              ///< polar, about the centroid [m4]
};

PolygonMeasures measure(std::span<const Vector2> corners);

/// Whether a counter-clockwise polygon turns left at every corner, or goes straight on.
bool is_convex(std::span<const Vector2> corners);

/// Whether a convex polygon holds a point; `margin` [m] is how far inside it has to lie.
bool holds(std::span<const Vector2> convex, const Vector2& point, Real margin = 0);

}  // namespace sazare::geometry
