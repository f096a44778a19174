#pragma once

/// The wall of a hole, measured on the faces of its mesh.

#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "sazare/geometry/face_map.hpp"
#include "sazare/geometry/tetra_mesh.hpp"

namespace sazare::runs {

struct HoleWall {
  Real area = 0;                    ///< [m2]
  Vector3 open = Vector3::Zero();   ///< sum of the faces' area vectors: 0 where the wall closes around the hole [m2]
  Vector3 axis = Vector3::Zero();   ///< 0 for a hole that is no cylinder; its largest component is positive
  Vector3 first = Vector3::Zero();  ///< beginning of the wall on the axis; for a hole without axis its centre [m]
  Vector3 last = Vector3::Zero();   ///< its end [m]
  Real length = 0, diameter = 0;    ///< along and across the axis; a hole without axis has the diameter of a like sphere [m]
  Real width = 0;                   ///< of a face around the axis, the mean [m]
  Real volume = 0;                  ///< [m3]

  bool has_axis() const { return !axis.isZero(); }
  /// Whether it is that of a hole: on other faces the pressure pushes the body as a whole.
  bool closes() const { return open.norm() <= 0.05 * area && volume > 0; }
  Real around() const { return std::numbers::pi * diameter / width; }  ///< faces on a circumference

  static constexpr Real few_faces = 7.5;  ///< around
};

/// How far a face reaches around an axis [m].
Real width_around(const Vector3& axis, const std::array<Vector3, 3>& corners);

HoleWall measure_wall(const geometry::TetraMesh& mesh, const std::vector<geometry::OuterFace>& faces);

/// Its size in words: "0.1 m across, 2 m long, about 12 faces around".
std::string size_text(const HoleWall& wall);

}  // namespace sazare::runs
