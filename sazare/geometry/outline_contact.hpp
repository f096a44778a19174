#pragma once

/// Where two outlines in the plane overlap: rectangles, circles and walls at any angle.

#include <array>
#include <cstdint>

#include "sazare/core/vector.hpp"

namespace sazare::geometry {

using Vector2 = Vector<2>;

enum class OutlineKind : std::uint8_t {
  rectangle,
  circle,  ///< half_width is its radius
  wall,    ///< a straight line of length 2 half_width; solid below its own x axis
};

/// Faces of a rectangle, as bits: outward along +x, +y, -x, -y of its own axes.
inline constexpr std::uint8_t all_faces = 15;

struct Outline {
  OutlineKind kind = OutlineKind::rectangle;
  std::uint8_t exposed = all_faces;  ///< faces that can touch something
  Vector2 centre = Vector2::Zero();  ///< [m]
  Vector2 axis = Vector2(1, 0);      ///< its own x axis
  Real half_width = 0;               ///< [m]
  Real half_height = 0;              ///< [m]

  Vector2 other_axis() const { return {-axis.y(), axis.x()}; }
};

struct OverlapPoint {
  Vector2 place = Vector2::Zero();  ///< [m]
  Real depth = 0;                   ///< [m], more than 0
};

/// Up to two points at which two outlines press on one another, all with one normal.
struct Overlap {
  int count = 0;
  Vector2 normal = Vector2::Zero();  ///< from the first outline to the second
  std::array<OverlapPoint, 2> points;
  Real share = 1;  ///< of the shorter face that lies over the other
};

/// Two rectangles, and a rectangle and a wall: the face of least overlap, and the opposite face cut to it (Gottschalk's
/// separating axis). Only faces that are exposed on both sides count, so that what slides over a row of joined rectangles does
/// not catch at their joints. Circles: the nearest point. A wall holds what comes from above its x axis, to a depth of the
/// smaller half of the other. Two walls never overlap.
Overlap overlap(const Outline& first, const Outline& second);

/// Radius of a circle about its centre that holds it [m].
Real outer_radius(const Outline& outline);

}  // namespace sazare::geometry
