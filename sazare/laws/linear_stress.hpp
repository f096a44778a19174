#pragma once

/// Stress that varies linearly over space, as it stands in the ground before anything is done to it.

#include <array>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct LinearStress {
  Matrix3 at_datum = Matrix3::Zero();   ///< symmetric, tension positive [Pa]
  Matrix3 per_depth = Matrix3::Zero();  ///< added per metre of depth [Pa/m]
  Vector3 down = -Vector3::UnitZ();     ///< unit vector along which depth grows
  Real datum = 0;                       ///< height of the plane from which depth is measured, along -down [m]

  bool is_zero() const { return at_datum.isZero(0) && per_depth.isZero(0); }
  Real depth(const Vector3& place) const { return datum + down.dot(place); }
  Matrix3 at(const Vector3& place) const { return at_datum + depth(place) * per_depth; }
};

/// Tractions at the corners of a triangle [Pa], each to act on a third of its area, with the force and the moment that the stress
/// has over the whole triangle: the second moments of a triangle about its centroid are a quarter of those of its corners.
inline std::array<Vector3, 3> corner_tractions(const LinearStress& stress, const std::array<Vector3, 3>& corners,
                                               const Vector3& normal) {
  const Vector3 centroid = (corners[0] + corners[1] + corners[2]) / 3;
  std::array<Vector3, 3> tractions;
  for (std::size_t corner = 0; corner < 3; ++corner)
    tractions[corner] = stress.at(centroid + (corners[corner] - centroid) / 4) * normal;
  return tractions;
}

}  // namespace sazare::laws
