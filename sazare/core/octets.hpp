#pragma once

/// A record of eight doubles worked on as a whole: two vectors, each with a further number behind it.

#include "sazare/core/registers.hpp"
#include "sazare/core/vector.hpp"

namespace sazare {

/// Half a record: the three parts of a vector, and a further number.
using Quad = RegisterOf<4>::Reals;

inline Quad load_half(const Real* from) { return *reinterpret_cast<const RegisterOf<4>::InMemory*>(from); }
inline void store_half(Real* to, const Quad& quad) { *reinterpret_cast<RegisterOf<4>::InMemory*>(to) = quad; }

/// The vector of one half with the further number of another.
inline Quad with_number_of(const Quad& other, const Quad& vector) { return __builtin_shufflevector(vector, other, 0, 1, 2, 7); }

#ifdef __AVX512F__

class Octet {
public:
  Octet() = default;
  Octet(const Quad& first, const Quad& second) : all_(__builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7)) {}
  /// One number in the first half, and another one in the second.
  static Octet halves(Real first, Real second) {
    return Octet(_mm512_mask_broadcastsd_pd(_mm512_set1_pd(first), 0xF0, _mm_set_sd(second)));
  }
  static Octet load(const Real* from) {
    // Copied here, since a reference would promise that the numbers are aligned.
    const RegisterOf<8>::Reals all = *reinterpret_cast<const RegisterOf<8>::InMemory*>(from);
    return Octet(all);
  }
  void store(Real* to) const { *reinterpret_cast<RegisterOf<8>::InMemory*>(to) = all_; }

  Quad second() const { return _mm512_extractf64x4_pd(all_, 1); }
  /// The further number of each half in all of its places.
  Octet numbers() const { return Octet(_mm512_permutex_pd(all_, 0xFF)); }
  /// With zeros in place of the second vector.
  Octet without_second_vector() const { return Octet(_mm512_maskz_mov_pd(0x8F, all_)); }
  /// With zeros where another one is not above zero.
  Octet where_above_zero(const Octet& other) const {
    return Octet(_mm512_maskz_mov_pd(_mm512_cmp_pd_mask(other.all_, _mm512_setzero_pd(), _CMP_GT_OQ), all_));
  }
  /// The first halves of two.
  friend Octet firsts(const Octet& a, const Octet& b) { return Octet(_mm512_shuffle_f64x2(a.all_, b.all_, 0x44)); }

  friend Octet operator+(const Octet& a, const Octet& b) { return Octet(a.all_ + b.all_); }
  friend Octet operator*(Real factor, const Octet& a) { return Octet(RegisterOf<8>::broadcast(factor) * a.all_); }
  friend Octet add_product(const Octet& a, const Octet& b, const Octet& c) {
    return Octet(_mm512_fmadd_pd(a.all_, b.all_, c.all_));
  }

  explicit Octet(const RegisterOf<8>::Reals& all) : all_(all) {}

private:
  RegisterOf<8>::Reals all_{};
};

#else

class Octet {
public:
  Octet() = default;
  Octet(const Quad& first, const Quad& second) : first_(first), second_(second) {}
  static Octet halves(Real first, Real second) { return {RegisterOf<4>::broadcast(first), RegisterOf<4>::broadcast(second)}; }
  static Octet load(const Real* from) { return {load_half(from), load_half(from + 4)}; }
  void store(Real* to) const {
    store_half(to, first_);
    store_half(to + 4, second_);
  }

  Quad second() const { return second_; }
  Octet numbers() const { return {RegisterOf<4>::broadcast(first_[3]), RegisterOf<4>::broadcast(second_[3])}; }
  Octet without_second_vector() const { return {first_, with_number_of(second_, Quad{})}; }
  Octet where_above_zero(const Octet& other) const {
    return {other.first_ > 0.0 ? first_ : Quad{}, other.second_ > 0.0 ? second_ : Quad{}};
  }
  friend Octet firsts(const Octet& a, const Octet& b) { return {a.first_, b.first_}; }

  friend Octet operator+(const Octet& a, const Octet& b) { return {a.first_ + b.first_, a.second_ + b.second_}; }
  friend Octet operator*(Real factor, const Octet& a) { return {factor * a.first_, factor * a.second_}; }
  friend Octet add_product(const Octet& a, const Octet& b, const Octet& c) {
    constexpr auto sum = &RegisterOf<4>::add_product;
    return {sum(a.first_, b.first_, c.first_), sum(a.second_, b.second_, c.second_)};
  }

private:
  Quad first_{}, second_{};
};

#endif

}  // namespace sazare
