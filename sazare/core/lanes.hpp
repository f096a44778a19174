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

/// A vector in every lane, and its products. Like a number it is not set unless it is told to: kernels have many of them.
struct LaneVector {
  std::array<Lanes, 3> part;

  Lanes& operator[](int axis) { return part[static_cast<std::size_t>(axis)]; }
  const Lanes& operator[](int axis) const { return part[static_cast<std::size_t>(axis)]; }

  friend LaneVector operator+(const LaneVector& a, const LaneVector& b) { return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}}; }
  friend LaneVector operator-(const LaneVector& a, const LaneVector& b) { return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}}; }
  friend LaneVector operator-(const LaneVector& a) { return {{-a[0], -a[1], -a[2]}}; }
  friend LaneVector operator*(Lanes factor, const LaneVector& a) { return {{factor * a[0], factor * a[1], factor * a[2]}}; }
};

/// Puts one vector into every lane.
inline LaneVector broadcast(const Vector3& a) { return {{broadcast(a[0]), broadcast(a[1]), broadcast(a[2])}}; }

/// Vectors that stand side by side in memory, one in each lane.
inline LaneVector load_vectors(const Vector3* from) {
  const Real* const numbers = from->data();
  const Lanes a = load_lanes(numbers), b = load_lanes(numbers + lane_count), c = load_lanes(numbers + 2 * lane_count);
#ifdef __AVX512F__
  const Lanes x = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, -1, -1);
  const Lanes y = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, -1, -1, -1);
  const Lanes z = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, -1, -1, -1);
  return {{__builtin_shufflevector(x, c, 0, 1, 2, 3, 4, 5, 10, 13), __builtin_shufflevector(y, c, 0, 1, 2, 3, 4, 8, 11, 14),
           __builtin_shufflevector(z, c, 0, 1, 2, 3, 4, 9, 12, 15)}};
#else
  const Lanes x = __builtin_shufflevector(a, b, 0, 3, 6, -1), y = __builtin_shufflevector(a, b, 1, 4, 7, -1);
  const Lanes z = __builtin_shufflevector(a, b, 2, 5, -1, -1);
  return {{__builtin_shufflevector(x, c, 0, 1, 2, 5), __builtin_shufflevector(y, c, 0, 1, 2, 6),
           __builtin_shufflevector(z, c, 0, 1, 4, 7)}};
#endif
}

/// Back again.
inline void store_vectors(const LaneVector& v, Vector3* to) {
  Real* const numbers = to->data();
#ifdef __AVX512F__
  const Lanes a = __builtin_shufflevector(v[0], v[1], 0, 8, -1, 1, 9, -1, 2, 10);
  const Lanes b = __builtin_shufflevector(v[0], v[1], -1, 3, 11, -1, 4, 12, -1, 5);
  const Lanes c = __builtin_shufflevector(v[0], v[1], 13, -1, 6, 14, -1, 7, 15, -1);
  store_lanes(numbers, __builtin_shufflevector(a, v[2], 0, 1, 8, 3, 4, 9, 6, 7));
  store_lanes(numbers + lane_count, __builtin_shufflevector(b, v[2], 10, 1, 2, 11, 4, 5, 12, 7));
  store_lanes(numbers + 2 * lane_count, __builtin_shufflevector(c, v[2], 0, 13, 2, 3, 14, 5, 6, 15));
#else
  const Lanes a = __builtin_shufflevector(v[0], v[1], 0, 4, -1, 1), b = __builtin_shufflevector(v[0], v[1], 5, -1, 2, 6);
  const Lanes c = __builtin_shufflevector(v[0], v[1], -1, 3, 7, -1);
  store_lanes(numbers, __builtin_shufflevector(a, v[2], 0, 1, 4, 3));
  store_lanes(numbers + lane_count, __builtin_shufflevector(b, v[2], 0, 5, 2, 3));
  store_lanes(numbers + 2 * lane_count, __builtin_shufflevector(c, v[2], 6, 1, 2, 7));
#endif
}

inline LaneVector cross(const LaneVector& a, const LaneVector& b) {
  return {{subtract_product(a[2], b[1], a[1] * b[2]), subtract_product(a[0], b[2], a[2] * b[0]),
           subtract_product(a[1], b[0], a[0] * b[1])}};
}

/// c + factor a and c + a x b.
inline LaneVector add_product(Lanes factor, const LaneVector& a, const LaneVector& c) {
  return {{add_product(factor, a[0], c[0]), add_product(factor, a[1], c[1]), add_product(factor, a[2], c[2])}};
}
inline LaneVector add_cross(const LaneVector& a, const LaneVector& b, const LaneVector& c) {
  LaneVector sum;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum[i] = subtract_product(a[k], b[j], add_product(a[j], b[k], c[i]));
  }
  return sum;
}

/// A 3 x 3 matrix in every lane, by columns.
struct LaneMatrix {
  std::array<LaneVector, 3> column;

  LaneVector& operator[](int i) { return column[static_cast<std::size_t>(i)]; }
  const LaneVector& operator[](int i) const { return column[static_cast<std::size_t>(i)]; }

  friend LaneVector operator*(const LaneMatrix& m, const LaneVector& v) {
    LaneVector product;
    for (int i = 0; i < 3; ++i) product[i] = add_product(m[2][i], v[2], add_product(m[1][i], v[1], m[0][i] * v[0]));
    return product;
  }
  friend LaneMatrix operator*(const LaneMatrix& a, const LaneMatrix& b) { return {{a * b[0], a * b[1], a * b[2]}}; }
};

inline Lanes dot(const LaneVector& a, const LaneVector& b) {
  return add_product(a[2], b[2], add_product(a[1], b[1], a[0] * b[0]));
}
inline Real dot(const Vector3& a, const Vector3& b) { return a.dot(b); }

/// Vectors of a law that is written for a type of numbers, `Real` or `Lanes`.
template <class T>
using VectorOf = std::conditional_t<std::is_same_v<T, Real>, Vector3, LaneVector>;

template <class T>
VectorOf<T> zero_vector() {
  if constexpr (std::is_same_v<T, Real>)
    return Vector3::Zero();
  else
    return {};
}

/// Rotations by quaternions; `twice` is 2 over their squared length.
inline LaneMatrix rotation_of(Lanes twice, Lanes x, Lanes y, Lanes z, Lanes w) {
  const Lanes x2 = twice * x, y2 = twice * y, z2 = twice * z;
  const Lanes xx = x2 * x, yy = y2 * y, zz = z2 * z, xy = x2 * y, xz = x2 * z, yz = y2 * z;
  const Lanes wx = x2 * w, wy = y2 * w, wz = z2 * w;
  return {{LaneVector{{1.0 - yy - zz, xy + wz, xz - wy}}, LaneVector{{xy - wz, 1.0 - xx - zz, yz + wx}},
           LaneVector{{xz + wy, yz - wx, 1.0 - xx - yy}}}};
}

/// c + m v, each sum begun with c.
inline LaneVector add_product(const LaneMatrix& m, const LaneVector& v, const LaneVector& c) {
  return add_product(v[2], m[2], add_product(v[1], m[1], add_product(v[0], m[0], c)));
}

/// m^T v.
inline LaneVector transposed(const LaneMatrix& m, const LaneVector& v) { return {{dot(m[0], v), dot(m[1], v), dot(m[2], v)}}; }

}  // namespace sazare
