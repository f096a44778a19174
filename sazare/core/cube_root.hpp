#pragma once

/// Cube roots of numbers above zero, single or in lanes.

#include <bit>

#include "sazare/core/lanes.hpp"
#include "sazare/core/twin_lanes.hpp"

namespace sazare {

namespace detail {

// A third of a number's bits is about a third of its logarithm; this is the offset with the least error, after Kahan, as in
// FreeBSD's s_cbrt.c.
inline constexpr Real cube_root_offset = 715094163.0 * 4294967296.0;

}  // namespace detail

/// Within 3.5 % of the cube root; far below any other number for 0.
inline Real rough_cube_root(Real a) {
  return std::bit_cast<Real>(static_cast<std::int64_t>(static_cast<Real>(std::bit_cast<std::int64_t>(a)) * (1.0 / 3) +
                                                       detail::cube_root_offset));
}
inline Lanes rough_cube_root(const Lanes& a) {
  const Lanes bits = __builtin_convertvector(reinterpret_cast<LongLanes>(a), Lanes);
  const LongLanes third = __builtin_convertvector(bits * (1.0 / 3) + detail::cube_root_offset, LongLanes);
  return reinterpret_cast<Lanes>(third);
}
inline TwinLanes rough_cube_root(const TwinLanes& a) { return {rough_cube_root(a.first), rough_cube_root(a.second)}; }

/// Within a few units in the last place, and 0 of 0: Halley's iteration makes each error the cube of the one before.
template <class Number>
Number cube_root(const Number& a) {
  Number root = rough_cube_root(a);
  for (int n = 0; n < 3; ++n) {
    const Number cube = root * root * root;
    root = root * ((cube + 2.0 * a) / maximum(Number(2.0 * cube + a), Number{} + 1e-300));
  }
  return root;
}

}  // namespace sazare
