#pragma once

/// Rotation in two and three dimensions behind the same names: an angular quantity is one number in 2-D, a vector in 3-D.

#include "sazare/core/vector.hpp"

namespace sazare {

template <int D>
inline constexpr int angular_dimension = D == 2 ? 1 : 3;

template <int D>
using Angular = Vector<angular_dimension<D>>;

template <int D>
using Rotation = Eigen::Matrix<Real, D, D>;

/// Moment of a force (or impulse) about the foot of its arm: arm x force.
inline Vector3 moment(const Vector3& arm, const Vector3& force) { return arm.cross(force); }
inline Angular<2> moment(const Vector<2>& arm, const Vector<2>& force) {
  return Angular<2>(arm.x() * force.y() - arm.y() * force.x());
}

/// Velocity of a point on an arm that turns: spin x arm.
inline Vector3 turned(const Vector3& spin, const Vector3& arm) { return spin.cross(arm); }
inline Vector<2> turned(const Angular<2>& spin, const Vector<2>& arm) { return Vector<2>(-spin[0] * arm.y(), spin[0] * arm.x()); }

}  // namespace sazare
