#pragma once

/// Four or eight doubles as one register.

#ifdef __AVX__
#include <immintrin.h>
#endif

#include "sazare/core/vector.hpp"

namespace sazare {

/// So many numbers in a register, and in memory at any place. Copying byte by byte would say the same, but not every compiler
/// makes one load or store of it.
template <int Width>
struct RegisterOf {};
template <>
struct RegisterOf<4> {
  using Reals = Real __attribute__((vector_size(32)));
  using InMemory = Real __attribute__((vector_size(32), aligned(8), may_alias));

  static Reals broadcast(Real value) { return Reals{value, value, value, value}; }
  static Reals converted(const float* from) {
#ifdef __AVX__
    return _mm256_cvtps_pd(_mm_loadu_ps(from));  // the compiler converts four numbers in two halves
#else
    return Reals{from[0], from[1], from[2], from[3]};
#endif
  }
  /// a b + c, rounded once where the processor can.
  static Reals add_product(const Reals& a, const Reals& b, const Reals& c) {
#ifdef __FMA__
    return _mm256_fmadd_pd(a, b, c);
#else
    return a * b + c;
#endif
  }
};
template <>
struct RegisterOf<8> {
  using Reals = Real __attribute__((vector_size(64)));
  using InMemory = Real __attribute__((vector_size(64), aligned(8), may_alias));

  static Reals broadcast(Real value) { return Reals{value, value, value, value, value, value, value, value}; }
};

}  // namespace sazare
