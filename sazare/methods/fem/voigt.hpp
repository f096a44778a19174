#pragma once

/// Strains and stresses as columns: xx, yy, zz, xy and in space also yz, zx; shear strains are engineering strains (twice the
/// tensor's).

#include "sazare/core/vector.hpp"

namespace sazare::methods::fem {

/// Plane strain keeps the stress across the plane.
template <int D>
inline constexpr int stress_size = D == 2 ? 4 : 6;

template <int D>
using Voigt = Eigen::Matrix<Real, stress_size<D>, 1>;

template <int D>
using VoigtMatrix = Eigen::Matrix<Real, stress_size<D>, stress_size<D>>;

/// The strain of a node's displacement where its shape function has this gradient: (stress_size, D).
template <int D>
Eigen::Matrix<Real, stress_size<D>, D> strain_operator(const Vector<D>& gradient) {
  Eigen::Matrix<Real, stress_size<D>, D> b = Eigen::Matrix<Real, stress_size<D>, D>::Zero();
  for (int axis = 0; axis < D; ++axis) b(axis, axis) = gradient[axis];
  b(3, 0) = gradient[1];
  b(3, 1) = gradient[0];
  if constexpr (D == 3) {
    b(4, 1) = gradient[2];
    b(4, 2) = gradient[1];
    b(5, 2) = gradient[0];
    b(5, 0) = gradient[2];
  }
  return b;
}

/// The tensor of a strain.
template <int D>
Matrix3 strain_tensor(const Voigt<D>& strain) {
  Matrix3 tensor = strain.template head<3>().asDiagonal();
  tensor(0, 1) = tensor(1, 0) = 0.5 * strain[3];
  if constexpr (D == 3) {
    tensor(1, 2) = tensor(2, 1) = 0.5 * strain[4];
    tensor(2, 0) = tensor(0, 2) = 0.5 * strain[5];
  }
  return tensor;
}

}  // namespace sazare::methods::fem
