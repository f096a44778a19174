#pragma once

/// Symmetric tensors as six numbers: xx, yy, zz, then yz, zx, xy times the root of two (Mandel), so that the product of two
/// tensors is that of their numbers.

#include "sazare/core/vector.hpp"

namespace sazare {

using Vector6 = Eigen::Matrix<Real, 6, 1, Eigen::DontAlign>;
using Matrix6 = Eigen::Matrix<Real, 6, 6, Eigen::DontAlign>;

inline constexpr Real root_of_two = 1.41421356237309504880;

inline Matrix3 tensor_of(const Vector6& numbers) {
  constexpr Real share = 1 / root_of_two;
  const Real yz = share * numbers[3], zx = share * numbers[4], xy = share * numbers[5];
  return Matrix3{{numbers[0], xy, zx}, {xy, numbers[1], yz}, {zx, yz, numbers[2]}};
}

/// Of the symmetric part of a matrix.
inline Vector6 numbers_of(const Matrix3& tensor) {
  constexpr Real share = 1 / root_of_two;
  Vector6 numbers;
  numbers << tensor(0, 0), tensor(1, 1), tensor(2, 2), share * (tensor(1, 2) + tensor(2, 1)),
      share * (tensor(2, 0) + tensor(0, 2)), share * (tensor(0, 1) + tensor(1, 0));
  return numbers;
}

/// The symmetric part of a force times a place: what a force at that point of a body is to its strain.
inline Vector6 force_on_strain(const Vector3& force, const Vector3& place) { return numbers_of(force * place.transpose()); }

}  // namespace sazare
