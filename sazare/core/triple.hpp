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
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Number>
Triple<Number> cross(const Triple<Number>& a, const Triple<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Number, class Condition>
Triple<Number> select(const Condition& condition, const Triple<Number>& yes, const Triple<Number>& no) {
  return {select(condition, yes.x, no.x), select(condition, yes.y, no.y), select(condition, yes.z, no.z)};
}

inline Triple<Real> triple(const Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }
inline Vector3 vector(const Triple<Real>& numbers) { return {numbers.x, numbers.y, numbers.z}; }

}  // namespace sazare
