#pragma once

/// Two, four or eight doubles as one register.

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <cstdint>

#include "sazare/core/vector.hpp"

namespace sazare {

/// So many numbers in a register, and in memory at any place. Copying byte by byte would say the same, but not every compiler
/// makes one load or store of it. Clang takes attributes of alignment before the sign of equality only: behind it they are lost.
template <int Width>
struct RegisterOf {};
template <>
struct RegisterOf<2> {
  using Reals = Real __attribute__((vector_size(16)));

  static Reals broadcast(Real value) { return Reals{value, value}; }
};
template <>
struct RegisterOf<4> {
  using Reals = Real __attribute__((vector_size(32)));
  using InMemory __attribute__((aligned(8), may_alias)) = Reals;
  using Places = std::int64_t __attribute__((vector_size(32)));
  static constexpr Places places = {0, 1, 2, 3};

  static Reals broadcast(Real value) { return Reals{value, value, value, value}; }
  /// The first of two in all places; compilers send it through memory.
  static Reals broadcast(const RegisterOf<2>::Reals& pair) {
#ifdef __AVX2__
    return _mm256_broadcastsd_pd(pair);
#else
    return broadcast(pair[0]);
#endif
  }
  /// So many numbers from memory, zeros beyond them.
  template <int Count>
  static Reals converted(const float* from) {
#ifdef __AVX512VL__
    return _mm256_cvtps_pd(_mm_maskz_loadu_ps((1 << Count) - 1, from));
#else
    return Reals{from[0], Count > 1 ? from[1] : 0, Count > 2 ? from[2] : 0, Count > 3 ? from[3] : 0};
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
  using InMemory __attribute__((aligned(8), may_alias)) = Reals;

  using Places = std::int64_t __attribute__((vector_size(64)));
  static constexpr Places places = {0, 1, 2, 3, 4, 5, 6, 7};

  static Reals broadcast(Real value) { return Reals{value, value, value, value, value, value, value, value}; }
  static Reals broadcast(const RegisterOf<2>::Reals& pair) {
#ifdef __AVX512F__
    return _mm512_broadcastsd_pd(pair);
#else
    return broadcast(pair[0]);
#endif
  }
  template <int Count>
  static Reals converted(const float* from) {
#ifdef __AVX512F__
    return _mm512_cvtps_pd(_mm256_maskz_loadu_ps((1 << Count) - 1, from));
#else
    return of_halves(RegisterOf<4>::converted<4>(from), RegisterOf<4>::converted<Count - 4>(from + 4));
#endif
  }
  static Reals add_product(const Reals& a, const Reals& b, const Reals& c) {
#ifdef __AVX512F__
    return _mm512_fmadd_pd(a, b, c);
#else
    const auto sum = &RegisterOf<4>::add_product;
    return of_halves(sum(lower(a), lower(b), lower(c)), sum(upper(a), upper(b), upper(c)));
#endif
  }

  static Real sum(const Reals& a) {
    const Half halves = lower(a) + upper(a);
    const RegisterOf<2>::Reals quarters =
        __builtin_shufflevector(halves, halves, 0, 1) + __builtin_shufflevector(halves, halves, 2, 3);
    return quarters[0] + quarters[1];
  }

private:
  using Half = RegisterOf<4>::Reals;

  static Half lower(const Reals& a) { return __builtin_shufflevector(a, a, 0, 1, 2, 3); }
  static Half upper(const Reals& a) { return __builtin_shufflevector(a, a, 4, 5, 6, 7); }
  static Reals of_halves(const Half& lower, const Half& upper) {
    return __builtin_shufflevector(lower, upper, 0, 1, 2, 3, 4, 5, 6, 7);
  }
};

/// Said of a register just loaded that is needed more than once: compilers would read its numbers from memory again each time.
template <class Reals>
void keep([[maybe_unused]] Reals& numbers) {
#ifdef __AVX512F__
  asm("" : "+v"(numbers));
#endif
}

/// The first numbers of a register, zeros in place of the others.
template <int Count, int Width>
typename RegisterOf<Width>::Reals first_of(const typename RegisterOf<Width>::Reals& numbers) {
  return RegisterOf<Width>::places < Count ? numbers : typename RegisterOf<Width>::Reals{};
}

}  // namespace sazare
