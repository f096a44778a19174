#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sazare {

/// The number type of the whole program.
using Real = double;

/// A vector of the D-dimensional space, D = 2 or 3.
template <int D>
using Vector = Eigen::Matrix<Real, D, 1>;

using Vector3 = Vector<3>;
using Matrix3 = Eigen::Matrix<Real, 3, 3>;

/// A rotation; kept at unit length by whoever integrates it.
using Quaternion = Eigen::Quaternion<Real>;

}  // namespace sazare
