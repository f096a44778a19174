#pragma once

#include <limits>

#include "sazare/core/lanes.hpp"
#include "sazare/core/triple.hpp"
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
  Number square_of_nearest(Triple<Number>& apart) const {
    const Number square = dot(apart, apart);
    if (!any_above(square, surely_nearest_)) return square;
    apart = nearest(apart);
    return dot(apart, apart);
  }

  /// From one place to the nearest image of another, of which any image is given.
  Triple<Number> nearest(Triple<Number> apart) const {
    if (!repeats_) return apart;
    apart.x -= length_.x * whole(apart.x * inverse_.x);
    apart.y -= length_.y * whole(apart.y * inverse_.y);
    apart.z -= length_.z * whole(apart.z * inverse_.z);
    return apart;
  }

  /// The periodic image of a place within the box.
  Triple<Number> wrapped(Triple<Number> place) const {
    if (!repeats_) return place;
    place.x -= length_.x * whole_below((place.x - lower_.x) * inverse_.x);
    place.y -= length_.y * whole_below((place.y - lower_.y) * inverse_.y);
    place.z -= length_.z * whole_below((place.z - lower_.z) * inverse_.z);
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
  Triple<Number> lower_, length_, inverse_;
  Number surely_nearest_;
};

}  // namespace sazare::state
