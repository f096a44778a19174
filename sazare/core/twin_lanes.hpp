#pragma once

/// Two `Lanes` worked on together as one number. A chain of roots and divisions takes hundreds of cycles in which a core has
/// little else to do; with a second chain beside it the units are busy.

#include "sazare/core/lanes.hpp"

namespace sazare {

struct TwinMask {
  LaneMask first{}, second{};

  bool operator[](int lane) const { return (lane < lane_count ? first[lane] : second[lane - lane_count]) != 0; }
  friend TwinMask operator~(const TwinMask& a) { return {~a.first, ~a.second}; }
};

class TwinLanes {
public:
  static constexpr int count = 2 * lane_count;

  Lanes first{}, second{};

  TwinLanes() = default;
  TwinLanes(const Lanes& one, const Lanes& other) : first(one), second(other) {}
  TwinLanes(Real value) : first(broadcast(value)), second(first) {}  // NOLINT(google-explicit-constructor): as numbers are

  Real operator[](int lane) const { return lane < lane_count ? first[lane] : second[lane - lane_count]; }
  void set(int lane, Real value) {
    if (lane < lane_count)
      first[lane] = value;
    else
      second[lane - lane_count] = value;
  }

  TwinLanes& operator+=(const TwinLanes& a) { return *this = *this + a; }
  TwinLanes& operator-=(const TwinLanes& a) { return *this = *this - a; }

  friend TwinLanes operator-(const TwinLanes& a) { return {-a.first, -a.second}; }
  friend TwinLanes operator+(const TwinLanes& a, const TwinLanes& b) { return {a.first + b.first, a.second + b.second}; }
  friend TwinLanes operator-(const TwinLanes& a, const TwinLanes& b) { return {a.first - b.first, a.second - b.second}; }
  friend TwinLanes operator*(const TwinLanes& a, const TwinLanes& b) { return {a.first * b.first, a.second * b.second}; }
  friend TwinLanes operator/(const TwinLanes& a, const TwinLanes& b) { return {a.first / b.first, a.second / b.second}; }
  friend TwinMask operator<(const TwinLanes& a, const TwinLanes& b) { return {a.first < b.first, a.second < b.second}; }
  friend TwinMask operator!=(const TwinLanes& a, const TwinLanes& b) { return {a.first != b.first, a.second != b.second}; }
  friend TwinMask operator>(const TwinLanes& a, const TwinLanes& b) { return {a.first > b.first, a.second > b.second}; }
};

inline TwinLanes select(const TwinMask& mask, const TwinLanes& yes, const TwinLanes& no) {
  return {select(mask.first, yes.first, no.first), select(mask.second, yes.second, no.second)};
}
inline bool any(const TwinMask& mask) { return any(LaneMask(mask.first | mask.second)); }
inline bool any_above(const TwinLanes& a, const TwinLanes& b) {
#ifdef __AVX512F__
  return (_mm512_cmp_pd_mask(a.first, b.first, _CMP_GT_OQ) | _mm512_cmp_pd_mask(a.second, b.second, _CMP_GT_OQ)) != 0;
#else
  return any(a > b);
#endif
}
inline bool all_above(const TwinLanes& a, const TwinLanes& b) {
  return all_above(a.first, b.first) && all_above(a.second, b.second);
}
inline TwinLanes maximum(const TwinLanes& a, const TwinLanes& b) {
  return {maximum(a.first, b.first), maximum(a.second, b.second)};
}
inline TwinLanes minimum(const TwinLanes& a, const TwinLanes& b) { return select(a < b, a, b); }
inline TwinLanes inverse_square_root(const TwinLanes& a) { return {inverse_square_root(a.first), inverse_square_root(a.second)}; }
inline TwinLanes root_of_quotient(const TwinLanes& a, const TwinLanes& b) {
  return {root_of_quotient(a.first, b.first), root_of_quotient(a.second, b.second)};
}
inline TwinLanes add_product(const TwinLanes& a, const TwinLanes& b, const TwinLanes& c) {
  return {add_product(a.first, b.first, c.first), add_product(a.second, b.second, c.second)};
}
inline TwinLanes subtract_product(const TwinLanes& a, const TwinLanes& b, const TwinLanes& c) {
  return {subtract_product(a.first, b.first, c.first), subtract_product(a.second, b.second, c.second)};
}
inline TwinLanes square_root(const TwinLanes& a) {
#ifdef __AVX512F__
  const TwinLanes inverse = inverse_square_root(a);  // not a number for 0
  return select(a != 0, a * inverse, a);
#else
  return {square_root(a.first), square_root(a.second)};
#endif
}

}  // namespace sazare
