#pragma once

/// Where two outlines in the plane overlap: rectangles, convex polygons, circles and walls at any angle.

#include <array>
#include <cstdint>
#include <span>

#include "sazare/geometry/plane/polygon.hpp"

namespace sazare::geometry {

enum class OutlineKind : std::uint8_t {
  rectangle,
  circle,   ///< half_width is its radius
  wall,     ///< a straight line of length 2 half_width; solid below its own x axis
  polygon,  ///< convex; half_width and half_height are half of the side of the square of equal area
};

/// Faces as bits: of a rectangle outward along +x, +y, -x, -y of its own axes, of a polygon from its n-th corner to the next.
using Faces = std::uint32_t;
inline constexpr Faces all_faces = 15;  ///< of a rectangle
inline constexpr int most_faces = 32;   ///< of a polygon

struct Outline {
  OutlineKind kind = OutlineKind::rectangle;
  Faces exposed = all_faces;              ///< that can touch something
  Vector2 centre = Vector2::Zero();       ///< [m]
  Vector2 axis = Vector2(1, 0);           ///< its own x axis
  Real half_width = 0;                    ///< [m]
  Real half_height = 0;                   ///< [m]
  std::span<const Vector2> corners = {};  ///< of a polygon, from its centre, in its own axes [m]

  Vector2 other_axis() const { return {-axis.y(), axis.x()}; }
};

/// A face of an outline: from `centre` to both sides by `half` along `along`.
struct Face {
  Vector2 centre, normal, along;
  Real half = 0;
};

int face_count(const Outline& outline);
Face face_of(const Outline& outline, int number);
inline bool is_exposed(const Outline& outline, int face) {
  return outline.kind == OutlineKind::wall || (outline.exposed >> face & 1) != 0;
}

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

/// Two rectangles or polygons, and one of them and a wall: the face of least overlap, and the opposite face cut to it
/// (Gottschalk's separating axis). Only faces that are exposed on both sides count, so that what slides over a row of joined
/// elements does not catch at their joints. Circles: the nearest point. A wall holds what comes from above its x axis, to a depth
/// of the smaller half of the other. Two walls never overlap.
Overlap overlap(const Outline& first, const Outline& second);

/// Radius of a circle about its centre that holds it [m].
Real outer_radius(const Outline& outline);

}  // namespace sazare::geometry
