#pragma once

/// A vector of three numbers that may be `Real` or `Lanes`, for laws that run on either.

#include "sazare/core/lanes.hpp"

namespace sazare {

template <class Number>
struct Triple {
  Number x{}, y{}, z{};

  friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Triple operator*(const Number& factor, const Triple& a) { return {factor * a.x, factor * a.y, factor * a.z}; }
};

template <class Number>
Number dot(const Triple<Number>& a, const Triple<Number>& b) {
  return add_product(a.z, b.z, add_product(a.y, b.y, Number(a.x * b.x)));
}

template <class Number>
Triple<Number> cross(const Triple<Number>& a, const Triple<Number>& b) {
  return {subtract_product(a.z, b.y, Number(a.y * b.z)), subtract_product(a.x, b.z, Number(a.z * b.x)),
          subtract_product(a.y, b.x, Number(a.x * b.y))};
}

/// c + factor a and c - factor a.
template <class Number>
Triple<Number> add_product(const Number& factor, const Triple<Number>& a, const Triple<Number>& c) {
  return {add_product(factor, a.x, c.x), add_product(factor, a.y, c.y), add_product(factor, a.z, c.z)};
}
template <class Number>
Triple<Number> subtract_product(const Number& factor, const Triple<Number>& a, const Triple<Number>& c) {
  return {subtract_product(factor, a.x, c.x), subtract_product(factor, a.y, c.y), subtract_product(factor, a.z, c.z)};
}

template <class Number, class Condition>
Triple<Number> select(const Condition& condition, const Triple<Number>& yes, const Triple<Number>& no) {
  return {select(condition, yes.x, no.x), select(condition, yes.y, no.y), select(condition, yes.z, no.z)};
}

inline Triple<Real> triple(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }
inline Vector3 vector(const Triple<Real>& numbers) { return {numbers.x, numbers.y, numbers.z}; }

}  // namespace sazare
