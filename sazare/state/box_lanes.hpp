#pragma once

#include <limits>

#include "sazare/core/vector_of.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::state {

/// A periodic box that lanes read.
template <class Number>
class BoxLanes {
public:
  explicit BoxLanes(const state::PeriodicBox& box) : repeats_(box.repeats()) {
    const Vector3 inverse = box.inverse();
    lower_ = {Number{} + box.lower.x(), Number{} + box.lower.y(), Number{} + box.lower.z()};
    length_ = {Number{} + box.length.x(), Number{} + box.length.y(), Number{} + box.length.z()};
    inverse_ = {Number{} + inverse.x(), Number{} + inverse.y(), Number{} + inverse.z()};
    const Real shortest = (box.length.array() > 0).select(box.length, std::numeric_limits<Real>::infinity()).minCoeff();
    surely_nearest_ = Number{} + 0.25 * shortest * shortest;
  }

  /// Squares of the distances `apart`, from some places to any images of others, which become the nearest. Most are: where no
  /// square is beyond that of half a box all of them are.
  Number square_of_nearest(VectorOf<Number>& apart) const {
    const Number square = dot(apart, apart);
    if (!any_above(square, surely_nearest_)) return square;
    apart = nearest(apart);
    return dot(apart, apart);
  }

  /// From one place to the nearest image of another, of which any image is given.
  VectorOf<Number> nearest(VectorOf<Number> apart) const {
    if (!repeats_) return apart;
    for (int axis = 0; axis < 3; ++axis) apart[axis] -= length_[axis] * whole(apart[axis] * inverse_[axis]);
    return apart;
  }

  /// The periodic image of a place within the box.
  VectorOf<Number> wrapped(VectorOf<Number> place) const {
    if (!repeats_) return place;
    for (int axis = 0; axis < 3; ++axis)
      place[axis] -= length_[axis] * whole_below((place[axis] - lower_[axis]) * inverse_[axis]);
    return place;
  }

private:
  /// Rounds to the nearest whole number, up to 2^51.
  static Number whole(const Number& number) {
    constexpr Real shift = 6755399441055744.0;  // 1.5 * 2^52
    return (number + shift) - shift;
  }
  static Number whole_below(const Number& number) {
    const Number nearest = whole(number);
    return select(nearest > number, nearest - 1, nearest);
  }

  bool repeats_;
  VectorOf<Number> lower_, length_, inverse_;
  Number surely_nearest_;
};

}  // namespace sazare::state
