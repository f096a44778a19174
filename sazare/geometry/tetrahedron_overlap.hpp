#pragma once

/// How far two tetrahedra reach into each other: their overlap, weighted with the depth below the nearest face.
///
///     phi(x) = min_m d_m(x)                        d_m  depth of a point below face m [m]
///     W = 1/2 int over A and B (phi_A + phi_B) dV  [m4]
///     -dW/du = 1/2 int over the faces of A within B phi_B n_A dA - 1/2 int over the faces of B within A phi_A n_B dA
///
/// phi is the distance potential of [Zhao2018], 0 on all faces and the inscribed radius in the middle: linear in the four parts
/// into which planes through the edges and the middle cut a tetrahedron. Where u moves B, W changes by the pressure phi/2 on the
/// faces of either that lie within the other and by nothing else, since phi is 0 on its own faces; the same pressure gives the
/// moment. So all integrals are of linear functions over plane convex polygons, and exact. Two parallel faces of area A that
/// overlap by d have W = A d^2/2 as far as their middles and away from their edges.
///
/// [Zhao2018] L. Zhao and others: A novel contact algorithm based on a distance potential function for the 3D discrete-element
/// method. Rock Mechanics and Rock Engineering, 2018, doi 10.1007/s00603-018-1556-4.

#include <cstdint>

#include "sazare/core/rotation.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::geometry {

/// A tetrahedron with the planes of its faces and its inscribed sphere.
struct SolidTetrahedron {
  Tetrahedron corners;             ///< [m]
  std::array<Vector3, 4> normals;  ///< outward, by face
  Vector3 middle;                  ///< of the inscribed sphere [m]
  Real radius = 0;                 ///< of the inscribed sphere [m]

  /// Depth of a point below a face [m].
  Real depth(int face, const Vector3& point) const {
    const auto m = static_cast<std::size_t>(face);
    return normals[m].dot(middle - point) + radius;
  }

  /// Farthest extent from the middle along a unit vector [m].
  Real extent(const Vector3& along) const;
};

SolidTetrahedron solid_tetrahedron(const Tetrahedron& corners);

/// Turned about the origin and moved, each face drawn in by `inset` [m]: smaller about its middle, and nothing from the inscribed
/// radius on.
SolidTetrahedron placed(const SolidTetrahedron& solid, const Vector3& position, const Matrix3& rotation, Real inset = 0);

/// Widest gap between two that a face of either shows [m]; no point of one is nearer to the other. Below 0 where no face parts
/// them.
Real gap(const SolidTetrahedron& first, const SolidTetrahedron& second);

/// By how much the faces of both together have to be drawn in, each by half of it, until the two do not overlap; 0 where they
/// don't [m].
Real shared_depth(const SolidTetrahedron& first, const SolidTetrahedron& second);

/// Faces as bits.
using FaceBits = std::uint8_t;
inline constexpr FaceBits all_four_faces = 15;

/// Where two tetrahedra meet. Moments are about the origin.
struct TetrahedronOverlap {
  Vector3 push = Vector3::Zero();     ///< -dW/du, on the second [m3]
  Vector3 turning = Vector3::Zero();  ///< its moment [m4]
  Real area = 0;                      ///< of the faces where they meet, across `normal` [m2]
  Vector3 normal = Vector3::Zero();   ///< from the first to the second: of the push on the faces that count
  Vector3 place = Vector3::Zero();    ///< middle of the pressure on them [m]

  bool is_empty() const { return !(area > 0); }
};

/// `first_counts` and `second_counts` are the faces from which the normal, the area and the place are taken, those through which
/// the two may touch; where none of them lies within the other tetrahedron all count.
TetrahedronOverlap overlap(const SolidTetrahedron& first, const SolidTetrahedron& second, FaceBits first_counts = all_four_faces,
                           FaceBits second_counts = all_four_faces);

/// W [m4].
Real overlap_weight(const SolidTetrahedron& first, const SolidTetrahedron& second);

}  // namespace sazare::geometry
