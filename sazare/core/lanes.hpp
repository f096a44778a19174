#pragma once

/// Several doubles worked on together. Laws are written once as templates and run on `Real` (tests, single evaluations)
/// or on `Lanes` (kernels: several joints or several bodies at a time).

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "sazare/core/registers.hpp"
#include "sazare/core/vector.hpp"

namespace sazare {

#ifdef __AVX512F__
inline constexpr int lane_count = 8;
#else
inline constexpr int lane_count = 4;
#endif

using Lanes = Real __attribute__((vector_size(8 * lane_count)));
using LongLanes = std::int64_t __attribute__((vector_size(8 * lane_count)));
using LaneMask = decltype(Lanes{} > Lanes{});

inline Lanes select(LaneMask mask, Lanes yes, Lanes no) { return mask ? yes : no; }
inline Real select(bool condition, Real yes, Real no) { return condition ? yes : no; }

inline bool any(LaneMask mask) {
#ifdef __AVX512F__
  const auto bits = reinterpret_cast<__m512i>(mask);
  return _mm512_test_epi64_mask(bits, bits) != 0;  // the compiler makes eight steps of the loop below
#elif defined(__AVX__)
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
#else
  std::int64_t bits = 0;
  for (int lane = 0; lane < lane_count; ++lane) bits |= mask[lane];
  return bits != 0;
#endif
}
inline bool any(bool condition) { return condition; }

/// Whether some a is above its b.
inline bool any_above(Lanes a, Lanes b) {
#ifdef __AVX512F__
  return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ) != 0;
#else
  return any(a > b);
#endif
}
inline bool any_above(Real a, Real b) { return a > b; }
/// Whether every a is above its b.
inline bool all_above(Lanes a, Lanes b) {
#ifdef __AVX512F__
  return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ) == 0xFF;
#else
  return !any(LaneMask(~(a > b)));
#endif
}

/// 0, 1, 2 ... by lane.
inline LongLanes lane_numbers() {
  LongLanes numbers;
  for (int lane = 0; lane < lane_count; ++lane) numbers[lane] = lane;
  return numbers;
}

using LaneBits = std::uint8_t;  ///< a lane each, the first one lowest
inline constexpr LaneBits all_lanes = (1u << lane_count) - 1;

inline LaneBits bits_of(LaneMask mask) {
#ifdef __AVX512F__
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask));
#elif defined(__AVX__)
  return static_cast<LaneBits>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
#else
  LaneBits bits = 0;
  for (int lane = 0; lane < lane_count; ++lane) bits |= static_cast<LaneBits>((mask[lane] & 1) << lane);
  return bits;
#endif
}

/// Which a are above their b.
inline LaneBits those_above(Lanes a, Lanes b) {
#ifdef __AVX512F__
  return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ);
#else
  return bits_of(a > b);
#endif
}

inline LaneMask mask_of(LaneBits bits) {
#ifdef __AVX512F__
  return reinterpret_cast<LaneMask>(_mm512_movm_epi64(bits));
#else
  constexpr LongLanes bit = {1, 2, 4, 8};
  return (bit & bits) != 0;
#endif
}

/// The bytes of a number, the lowest one first, one in each lane.
inline LongLanes spread_bytes(std::uint64_t bytes) {
#ifdef __AVX512F__
  return reinterpret_cast<LongLanes>(_mm512_cvtepu8_epi64(_mm_cvtsi64_si128(static_cast<long long>(bytes))));
#else
  LongLanes spread;
  for (int lane = 0; lane < lane_count; ++lane) spread[lane] = static_cast<std::int64_t>(bytes >> 8 * lane & 0xFF);
  return spread;
#endif
}

using LooseLanes = RegisterOf<lane_count>::InMemory;  ///< at any number of a row of them

inline Lanes load_lanes(const Real* from) { return *reinterpret_cast<const LooseLanes*>(from); }
inline void store_lanes(Real* to, const Lanes& lanes) { *reinterpret_cast<LooseLanes*>(to) = lanes; }

inline Lanes broadcast(Real value) { return RegisterOf<lane_count>::broadcast(value); }

inline Lanes maximum(Lanes a, Lanes b) { return a > b ? a : b; }
inline Real maximum(Real a, Real b) { return a > b ? a : b; }

inline Lanes minimum(Lanes a, Lanes b) { return a < b ? a : b; }
inline Real minimum(Real a, Real b) { return a < b ? a : b; }

inline Lanes square_root(Lanes a) {
#ifdef __AVX512F__
  return _mm512_sqrt_pd(a);
#elif defined(__AVX__)
  return _mm256_sqrt_pd(a);
#else
  for (int lane = 0; lane < lane_count; ++lane) a[lane] = std::sqrt(a[lane]);
  return a;
#endif
}
inline Real square_root(Real a) { return std::sqrt(a); }

/// 1 / sqrt(a), within 2e-16 of it. A division and a root keep one unit busy for 17 and 19 cycles where eight numbers are worked
/// on; a first guess to 14 bits and a correction of fourth order take half of that and all units.
inline Lanes inverse_square_root(Lanes a) {
#ifdef __AVX512F__
  const __m512d one = _mm512_set1_pd(1), guess = _mm512_rsqrt14_pd(a),
                error = _mm512_fnmadd_pd(_mm512_mul_pd(a, guess), guess, one);
  const __m512d series =
      _mm512_fmadd_pd(_mm512_fmadd_pd(_mm512_set1_pd(5.0 / 16), error, _mm512_set1_pd(3.0 / 8)), error, _mm512_set1_pd(0.5));
  return _mm512_fmadd_pd(_mm512_mul_pd(guess, error), series, guess);
#else
  return 1.0 / square_root(a);
#endif
}
inline Real inverse_square_root(Real a) { return 1 / std::sqrt(a); }

/// sqrt(a / b), both above zero and a b neither too small nor too large for a double.
inline Lanes root_of_quotient(Lanes a, Lanes b) {
#ifdef __AVX512F__
  return a * inverse_square_root(a * b);
#else
  return square_root(a / b);
#endif
}
inline Real root_of_quotient(Real a, Real b) { return std::sqrt(a / b); }

/// a b + c and c - a b, rounded once where the processor can: half of the operations of a product of vectors. Said here and not
/// left to the compiler, which would choose anew wherever a function is inlined.
inline Lanes add_product(Lanes a, Lanes b, Lanes c) {
#ifdef __AVX512F__
  return _mm512_fmadd_pd(a, b, c);
#elif defined(__FMA__)
  return _mm256_fmadd_pd(a, b, c);
#else
  return a * b + c;
#endif
}
inline Lanes subtract_product(Lanes a, Lanes b, Lanes c) {
#ifdef __AVX512F__
  return _mm512_fnmadd_pd(a, b, c);
#elif defined(__FMA__)
  return _mm256_fnmadd_pd(a, b, c);
#else
  return c - a * b;
#endif
}

inline Real add_product(Real a, Real b, Real c) {
#ifdef __FMA__
  return __builtin_fma(a, b, c);
#else
  return a * b + c;
#endif
}
inline Real subtract_product(Real a, Real b, Real c) { return add_product(-a, b, c); }

}  // namespace sazare
