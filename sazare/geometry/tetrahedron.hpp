#pragma once

#include <array>

#include "sazare/core/vector.hpp"

namespace sazare::geometry {

/// Four corners [m]. Corners 1, 2, 3 are counter-clockwise seen from outside, so that the volume is positive.
using Tetrahedron = std::array<Vector3, 4>;

/// Corners of local face f, the face opposite corner f, counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 3>, 4> tetrahedron_faces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Signed volume [m3]: negative when the corners are inverted.
inline Real volume(const Tetrahedron& corners) {
  const Vector3 a = corners[1] - corners[0];
  const Vector3 b = corners[2] - corners[0];
  const Vector3 c = corners[3] - corners[0];
  return a.cross(b).dot(c) / 6;
}

/// Centre of mass [m].
inline Vector3 centroid(const Tetrahedron& corners) { return (corners[0] + corners[1] + corners[2] + corners[3]) / 4; }

/// Inertia tensor about the centroid for a density of 1 kg/m3 [kg m2].
///
///     J = tr(C) I - C      C = V / 20  sum_k  r_k r_k^T      r_k  corner k from the centroid [m],  V  volume
///     [m3]
///
/// Exact: the second moment of a simplex is that of its corners and its centroid, with weights V/20 and 4V/5.
inline Matrix3 inertia_about_centroid(const Tetrahedron& corners) {
  const Vector3 center = centroid(corners);
  Matrix3 second_moment = Matrix3::Zero();
  for (const Vector3& corner : corners) {
    const Vector3 arm = corner - center;
    second_moment += arm * arm.transpose();
  }
  second_moment *= volume(corners) / 20;
  return second_moment.trace() * Matrix3::Identity() - second_moment;
}

/// Outward vector of local face f whose length is the face's area [m2].
inline Vector3 face_area_vector(const Tetrahedron& corners, int face) {
  const auto& [a, b, c] = tetrahedron_faces[static_cast<std::size_t>(face)];
  const auto at = [&](int corner) -> const Vector3& { return corners[static_cast<std::size_t>(corner)]; };
  return (at(b) - at(a)).cross(at(c) - at(a)) / 2;
}

/// Area of local face f [m2].
inline Real face_area(const Tetrahedron& corners, int face) { return face_area_vector(corners, face).norm(); }

/// Unit vector of local face f that points out of the tetrahedron.
inline Vector3 outward_normal(const Tetrahedron& corners, int face) { return face_area_vector(corners, face).normalized(); }

/// Unit vector of local face f that points into the tetrahedron.
inline Vector3 inward_normal(const Tetrahedron& corners, int face) { return -outward_normal(corners, face); }

}  // namespace sazare::geometry
