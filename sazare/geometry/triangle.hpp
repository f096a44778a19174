#pragma once

/// A triangle in space: the point of it that is nearest to another one, and what goes through it.

#include <array>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::geometry {

using Triangle = std::array<Vector3, 3>;

inline Vector3 area_vector(const Triangle& corners) { return 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]); }

/// A point of a triangle, and on which part of it: corner 0 to 2, side 3 to 5, which leads from corner `part - 3` to the next
/// one, or the face, 6.
struct TrianglePoint {
  Vector3 place;
  int part = 0;
};

/// The point that is nearest to another one; after Ericson, Real-Time Collision Detection, 5.1.5.
inline TrianglePoint nearest_on(const Triangle& corners, const Vector3& point) {
  const Vector3 &a = corners[0], &b = corners[1], &c = corners[2];
  const Vector3 ab = b - a, ac = c - a, ap = point - a;
  const Real d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {a, 0};
  const Vector3 bp = point - b;
  const Real d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {b, 1};
  const Real vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, 3};
  const Vector3 cp = point - c;
  const Real d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {c, 2};
  const Real vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, 5};
  const Real va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 4};
  const Real sum = va + vb + vc;
  return {a + vb / sum * ab + vc / sum * ac, 6};
}

inline Vector3 nearest_point(const Triangle& corners, const Vector3& point) { return nearest_on(corners, point).place; }

/// Whether the straight way from one point to another leads through the triangle, to whose face edges and corners belong.
inline bool leads_through(const Triangle& corners, const Vector3& from, const Vector3& to) {
  constexpr Real rounding = 1e-9;  // of the face: no way leads between two triangles at their edge
  const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const Real before = normal.dot(from - corners[0]), after = normal.dot(to - corners[0]);
  if ((before > 0) == (after > 0)) return false;
  const Vector3 place = from + before / (before - after) * (to - from);
  for (std::size_t n = 0; n < 3; ++n)
    if (normal.dot((corners[(n + 1) % 3] - corners[n]).cross(place - corners[n])) < -rounding * normal.squaredNorm())
      return false;
  return true;
}

}  // namespace sazare::geometry
