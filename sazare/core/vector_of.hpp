#pragma once

/// Vectors of two or three numbers of any kind, for laws that are written once: `VectorOf<Real>` is Vector3, `VectorOf<Real, 2>`
/// a vector of the plane, and `VectorOf<Lanes>` has a vector in every lane. The products below give the same bits for each kind
/// of number.

#include <array>
#include <concepts>
#include <type_traits>
#include <utility>

#include "sazare/core/lanes.hpp"

namespace sazare {

/// A vector in every lane. Like a number it is not set unless it is told to: kernels have many of them.
template <class Number, int D>
struct PackVector {
  std::array<Number, D> part;

  Number& operator[](int axis) { return part[static_cast<std::size_t>(axis)]; }
  const Number& operator[](int axis) const { return part[static_cast<std::size_t>(axis)]; }

  friend PackVector operator+(const PackVector& a, const PackVector& b) {
    return made([&](int axis) { return a[axis] + b[axis]; });
  }
  friend PackVector operator-(const PackVector& a, const PackVector& b) {
    return made([&](int axis) { return a[axis] - b[axis]; });
  }
  friend PackVector operator-(const PackVector& a) {
    return made([&](int axis) { return -a[axis]; });
  }
  friend PackVector operator*(const Number& factor, const PackVector& a) {
    return made([&](int axis) { return factor * a[axis]; });
  }

private:
  static PackVector made(const auto& number_along) {
    PackVector vector;
    for (int axis = 0; axis < D; ++axis) vector[axis] = number_along(axis);
    return vector;
  }
};

/// A vector of a law that is written for a type of numbers: `Real`, `Lanes` or `TwinLanes`.
template <class Number, int D = 3>
using VectorOf = std::conditional_t<std::is_same_v<Number, Real>, Vector<D>, PackVector<Number, D>>;

using LaneVector = VectorOf<Lanes>;

/// The number of which a vector consists.
template <class Vector>
using NumberOf = std::remove_cvref_t<decltype(std::declval<const Vector&>()[0])>;

template <class Vector>
concept IsVectorOf = std::same_as<Vector, VectorOf<NumberOf<Vector>>>;

template <class Number>
VectorOf<Number> zero_vector() {
  if constexpr (std::is_same_v<Number, Real>)
    return Vector3::Zero();
  else
    return {};
}

template <IsVectorOf Vector>
NumberOf<Vector> dot(const Vector& a, const Vector& b) {
  return add_product(a[2], b[2], add_product(a[1], b[1], NumberOf<Vector>(a[0] * b[0])));
}

template <IsVectorOf Vector>
Vector cross(const Vector& a, const Vector& b) {
  using Number = NumberOf<Vector>;
  return {subtract_product(a[2], b[1], Number(a[1] * b[2])), subtract_product(a[0], b[2], Number(a[2] * b[0])),
          subtract_product(a[1], b[0], Number(a[0] * b[1]))};
}

/// c + factor a, c - factor a and c + a x b.
template <IsVectorOf Vector>
Vector add_product(const NumberOf<Vector>& factor, const Vector& a, const std::type_identity_t<Vector>& c) {
  return {add_product(factor, a[0], c[0]), add_product(factor, a[1], c[1]), add_product(factor, a[2], c[2])};
}
template <IsVectorOf Vector>
Vector subtract_product(const NumberOf<Vector>& factor, const Vector& a, const std::type_identity_t<Vector>& c) {
  return {subtract_product(factor, a[0], c[0]), subtract_product(factor, a[1], c[1]), subtract_product(factor, a[2], c[2])};
}
template <IsVectorOf Vector>
Vector add_cross(const Vector& a, const Vector& b, const Vector& c) {
  Vector sum;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum[i] = subtract_product(a[k], b[j], add_product(a[j], b[k], c[i]));
  }
  return sum;
}

template <class Condition, IsVectorOf Vector>
Vector select(const Condition& condition, const Vector& yes, const Vector& no) {
  return {select(condition, yes[0], no[0]), select(condition, yes[1], no[1]), select(condition, yes[2], no[2])};
}

/// Puts one vector into every lane.
inline LaneVector broadcast(const Vector3& a) { return {{broadcast(a[0]), broadcast(a[1]), broadcast(a[2])}}; }

/// A 3 x 3 matrix in every lane, by columns.
struct LaneMatrix {
  std::array<LaneVector, 3> column;

  LaneVector& operator[](int i) { return column[static_cast<std::size_t>(i)]; }
  const LaneVector& operator[](int i) const { return column[static_cast<std::size_t>(i)]; }

  friend LaneVector operator*(const LaneMatrix& m, const LaneVector& v) {
    LaneVector product;
    for (int i = 0; i < 3; ++i) product[i] = add_product(m[2][i], v[2], add_product(m[1][i], v[1], m[0][i] * v[0]));
    return product;
  }
  friend LaneMatrix operator*(const LaneMatrix& a, const LaneMatrix& b) { return {{a * b[0], a * b[1], a * b[2]}}; }
};

/// The columns of a rotation by a quaternion; `twice` is 2 over its squared length.
template <class Number>
std::array<VectorOf<Number>, 3> rotation_of(Number twice, Number x, Number y, Number z, Number w) {
  const Number x2 = twice * x, y2 = twice * y, z2 = twice * z;
  const Number xx = x2 * x, yy = y2 * y, zz = z2 * z, xy = x2 * y, xz = x2 * z, yz = y2 * z;
  const Number wx = x2 * w, wy = y2 * w, wz = z2 * w;
  return {VectorOf<Number>{1.0 - yy - zz, xy + wz, xz - wy}, VectorOf<Number>{xy - wz, 1.0 - xx - zz, yz + wx},
          VectorOf<Number>{xz + wy, yz - wx, 1.0 - xx - yy}};
}

/// c + m v, each sum begun with c.
inline LaneVector add_product(const LaneMatrix& m, const LaneVector& v, const LaneVector& c) {
  return add_product(v[2], m[2], add_product(v[1], m[1], add_product(v[0], m[0], c)));
}

/// m^T v.
inline LaneVector transposed(const LaneMatrix& m, const LaneVector& v) { return {{dot(m[0], v), dot(m[1], v), dot(m[2], v)}}; }

}  // namespace sazare
