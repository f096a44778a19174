#pragma once

#include <concepts>
#include <limits>

#include "sazare/core/time.hpp"

namespace sazare {

/// The whole part of a number, as an integer: the nearest there is where it is out of range, 0 where it is not a number.
template <std::integral Integer>
constexpr Integer saturated(Real number) {
  using Limits = std::numeric_limits<Integer>;
  if (!(number == number)) return 0;
  if (number >= static_cast<Real>(Limits::max())) return Limits::max();
  if (number <= static_cast<Real>(Limits::min())) return Limits::min();
  return static_cast<Integer>(number);
}

}  // namespace sazare
