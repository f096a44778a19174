#pragma once

/// A rotation as a unit quaternion of numbers that may be `Real` or `Lanes`, for laws that run on either.

#include "sazare/core/vector_of.hpp"

namespace sazare {

template <class Number>
struct Turn {
  Number w{}, x{}, y{}, z{};

  VectorOf<Number> axis() const { return {x, y, z}; }
};

/// The vector, turned.
template <class Number>
VectorOf<Number> turned(const Turn<Number>& turn, const VectorOf<Number>& vector) {
  const VectorOf<Number> axis = turn.axis(), once = cross(axis, vector), twice = once + once;
  return vector + turn.w * twice + cross(axis, twice);
}

/// What turns the first into the second: second = result * first.
template <class Number>
Turn<Number> turn_between(const Turn<Number>& first, const Turn<Number>& second) {
  const VectorOf<Number> axis = first.w * second.axis() - second.w * first.axis() + cross(first.axis(), second.axis());
  return {second.w * first.w + dot(second.axis(), first.axis()), axis[0], axis[1], axis[2]};
}

}  // namespace sazare
