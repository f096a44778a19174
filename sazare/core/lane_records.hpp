#pragma once

/// Between records in memory and lanes: the n-th double of `lane_count` records becomes one `Lanes`, and back.

#include <array>
#include <concepts>

#include "sazare/core/octets.hpp"
#include "sazare/core/vector_of.hpp"

namespace sazare {

#ifdef __AVX512F__
// Steps of turning records into lanes: what two registers have at some places, and pairs of numbers of two registers, side by
// side. Shuffles of these kinds read no table of places.
inline Lanes even_numbers(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14); }
inline Lanes odd_numbers(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15); }
inline Lanes even_pairs(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13); }
inline Lanes odd_pairs(const Lanes& a, const Lanes& b) { return __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15); }
#endif

/// Square of `lane_count` records by as many doubles, turned over its diagonal.
inline void transpose(std::array<Lanes, lane_count>& rows) {
#ifdef __AVX512F__
  std::array<Lanes, 4> even, odd;
  for (std::size_t i = 0; i < 4; ++i) {
    even[i] = even_numbers(rows[2 * i], rows[2 * i + 1]);
    odd[i] = odd_numbers(rows[2 * i], rows[2 * i + 1]);
  }
  const auto turn = [&](const std::array<Lanes, 4>& of, std::size_t to) {
    const Lanes a = even_pairs(of[0], of[1]), b = odd_pairs(of[0], of[1]), c = even_pairs(of[2], of[3]),
                d = odd_pairs(of[2], of[3]);
    rows[to] = even_pairs(a, c);
    rows[to + 2] = even_pairs(b, d);
    rows[to + 4] = odd_pairs(a, c);
    rows[to + 6] = odd_pairs(b, d);
  };
  turn(even, 0);
  turn(odd, 1);
#else
  const Lanes a = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6),
              b = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7);
  const Lanes c = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6),
              d = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  rows[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  rows[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  rows[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
#endif
}

/// Numbers of `lane_count` quads become four `Lanes`; `quad(lane)` is that of a lane. For what is worked on before it is turned:
/// what stands in memory is loaded in lanes by `load_quads`.
template <class QuadOf>
std::array<Lanes, 4> lanes_of_quads(const QuadOf& quad) {
#ifdef __AVX512F__
  const auto halves = [&](std::size_t lane) { return _mm512_insertf64x4(_mm512_castpd256_pd512(quad(lane)), quad(lane + 2), 1); };
  const Lanes zero = halves(0), one = halves(1), four = halves(4), five = halves(5), even = even_numbers(zero, one),
              even2 = even_numbers(four, five), odd = odd_numbers(zero, one), odd2 = odd_numbers(four, five);
  return {even_pairs(even, even2), even_pairs(odd, odd2), odd_pairs(even, even2), odd_pairs(odd, odd2)};
#else
  std::array<Lanes, lane_count> rows{quad(0), quad(1), quad(2), quad(3)};
  transpose(rows);
  return rows;
#endif
}

/// Four doubles of `lane_count` records become four `Lanes`; `from(lane)` says where those of a lane begin. Parts of two or four
/// records are put side by side as they are loaded, which takes no unit that turns them over.
template <class From>
requires std::invocable<const From&, std::size_t> std::array<Lanes, 4> load_quads(const From& from) {
#ifdef __AVX512F__
  return lanes_of_quads([&](std::size_t lane) { return load_half(from(lane)); });
#else
  std::array<Lanes, 4> fields;
  const auto halves = [&](std::size_t lane, int number) {
#ifdef __AVX__
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(from(lane) + number)), _mm_loadu_pd(from(lane + 2) + number),
                                1);
#else
    const Real *first = from(lane) + number, *second = from(lane + 2) + number;
    return Lanes{first[0], first[1], second[0], second[1]};
#endif
  };
  for (std::size_t i = 0; i < 4; i += 2) {
    const Lanes even = halves(0, static_cast<int>(i)), odd = halves(1, static_cast<int>(i));
    fields[i] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
    fields[i + 1] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
  }
  return fields;
#endif
}
inline std::array<Lanes, 4> load_quads(const std::array<const Real*, lane_count>& from) {
  return load_quads([&](std::size_t lane) { return from[lane]; });
}

/// Back again; `to(lane)` says where. Where lanes have the same record they must have the same numbers.
template <class To>
void store_quads(const std::array<Lanes, 4>& fields, const To& to) {
#ifdef __AVX512F__
  std::array<Lanes, 4> pairs, halves;
  for (std::size_t i = 0; i < 4; i += 2) {
    pairs[i] = __builtin_shufflevector(fields[i], fields[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[i + 1] = __builtin_shufflevector(fields[i], fields[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    halves[i] = __builtin_shufflevector(pairs[i], pairs[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    halves[i + 2] = __builtin_shufflevector(pairs[i], pairs[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (std::size_t lane = 0; lane < lane_count; ++lane)  // a number of turns that the compiler knows: halves stay in registers
    _mm256_storeu_pd(to(lane), lane < 4 ? _mm512_castpd512_pd256(halves[lane]) : _mm512_extractf64x4_pd(halves[lane - 4], 1));
#else
  std::array<Lanes, lane_count> rows = fields;
  transpose(rows);
  for (std::size_t lane = 0; lane < lane_count; ++lane) store_lanes(to(lane), rows[lane]);
#endif
}

/// Pairs of records of eight numbers in lanes. What nobody reads is not made.
struct PairsOfRecords {
  std::array<Lanes, 8> difference, first, second;  ///< `difference`: second less first
};

/// `first(lane)` and `second(lane)` say where the records of a lane begin.
template <class First, class Second>
PairsOfRecords load_pairs(const First& first, const Second& second) {
  PairsOfRecords pairs;
#ifdef __AVX512F__  // differences are turned into lanes once, and not what either record has
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    pairs.first[lane] = load_lanes(first(lane));
    pairs.second[lane] = load_lanes(second(lane));
    pairs.difference[lane] = pairs.second[lane] - pairs.first[lane];
  }
  transpose(pairs.first);
  transpose(pairs.second);
  transpose(pairs.difference);
#else
  for (std::size_t half = 0; half < 8; half += 4) {
    const auto one = load_quads([&](std::size_t lane) { return first(lane) + half; }),
               other = load_quads([&](std::size_t lane) { return second(lane) + half; });
    for (std::size_t i = 0; i < 4; ++i) {
      pairs.first[half + i] = one[i];
      pairs.second[half + i] = other[i];
      pairs.difference[half + i] = other[i] - one[i];
    }
  }
#endif
  return pairs;
}

/// Eight numbers of each lane as records.
inline std::array<Octet, lane_count> octets_of(const std::array<Lanes, 8>& fields) {
  std::array<Octet, lane_count> records;
#ifdef __AVX512F__
  std::array<Lanes, lane_count> rows = fields;
  transpose(rows);
  for (std::size_t lane = 0; lane < lane_count; ++lane) records[lane] = Octet(rows[lane]);
#else
  std::array<Lanes, lane_count> first{fields[0], fields[1], fields[2], fields[3]},
      second{fields[4], fields[5], fields[6], fields[7]};
  transpose(first);
  transpose(second);
  for (std::size_t lane = 0; lane < lane_count; ++lane) records[lane] = Octet(first[lane], second[lane]);
#endif
  return records;
}

/// Numbers in single precision, two in the place of each double of a record.
using FloatLanes = float __attribute__((vector_size(4 * lane_count)));
using FloatPairs = float __attribute__((vector_size(8 * lane_count)));

using LooseFloats __attribute__((aligned(4), may_alias)) = FloatLanes;  ///< at any place in memory

/// Rounded to single precision.
inline FloatLanes single(const Lanes& numbers) {
#ifdef __AVX512F__  // the compiler converts eight numbers in two halves
  return _mm512_cvtpd_ps(numbers);
#else
  return __builtin_convertvector(numbers, FloatLanes);
#endif
}

inline std::array<Lanes, 2> unpack(const Lanes& pairs) {
  const auto all = reinterpret_cast<FloatPairs>(pairs);
#ifdef __AVX512F__  // the compiler converts eight numbers in two halves
  const __m512i first = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 0, 0, 0, 0, 0, 0, 0, 0),
                second = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 0, 0, 0, 0, 0, 0, 0, 0);
  return {_mm512_cvtps_pd(_mm512_castps512_ps256(_mm512_permutexvar_ps(first, all))),
          _mm512_cvtps_pd(_mm512_castps512_ps256(_mm512_permutexvar_ps(second, all)))};
#elif defined(__AVX2__)  // as for eight
  const __m256 sorted = _mm256_permutevar8x32_ps(all, _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7));
  return {_mm256_cvtps_pd(_mm256_castps256_ps128(sorted)), _mm256_cvtps_pd(_mm256_extractf128_ps(sorted, 1))};
#else
  return {__builtin_convertvector(__builtin_shufflevector(all, all, 0, 2, 4, 6), Lanes),
          __builtin_convertvector(__builtin_shufflevector(all, all, 1, 3, 5, 7), Lanes)};
#endif
}

inline Lanes pack(const Lanes& first, const Lanes& second) {
#ifdef __AVX512F__
  const __m512 one = _mm512_castps256_ps512(_mm512_cvtpd_ps(first)), other = _mm512_castps256_ps512(_mm512_cvtpd_ps(second));
  const __m512i in_turn = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
  return _mm512_castps_pd(_mm512_permutex2var_ps(one, in_turn, other));
#elif defined(__AVX2__)
  const __m128 one = _mm256_cvtpd_ps(first), other = _mm256_cvtpd_ps(second);
  return _mm256_castps_pd(_mm256_set_m128(_mm_unpackhi_ps(one, other), _mm_unpacklo_ps(one, other)));
#else
  const FloatLanes one = __builtin_convertvector(first, FloatLanes), other = __builtin_convertvector(second, FloatLanes);
  return reinterpret_cast<Lanes>(__builtin_shufflevector(one, other, 0, 4, 1, 5, 2, 6, 3, 7));
#endif
}

/// A record read or written as doubles, four or `lane_count` at a time; one pointer per lane.
template <class Record>
using LanePointers = std::array<Record*, lane_count>;

/// Four doubles of each lane's record, from number `begin` on.
template <class Record>
std::array<Lanes, 4> load_quad(const LanePointers<Record>& records, std::size_t begin) {
  return load_quads([&](std::size_t lane) { return reinterpret_cast<const Real*>(records[lane]) + begin; });
}

/// Writes four doubles of each lane's record, from number `begin` on.
template <class Record>
void store_quad(const std::array<Lanes, 4>& fields, const LanePointers<Record>& records, std::size_t begin) {
  store_quads(fields, [&](std::size_t lane) { return reinterpret_cast<Real*>(records[lane]) + begin; });
}

/// The first `Count` doubles of each lane's record, and back again.
template <int Count, class Record>
std::array<Lanes, Count> load_records(const LanePointers<Record>& records) {
  static_assert(Count % 4 == 0 && sizeof(Record) >= Count * sizeof(Real));
  std::array<Lanes, Count> fields;
  for (std::size_t first = 0; first < Count; first += 4) {
    const auto quad = load_quad(records, first);
    for (std::size_t i = 0; i < 4; ++i) fields[first + i] = quad[i];
  }
  return fields;
}

template <std::size_t Count, class Record>
void store_records(const std::array<Lanes, Count>& fields, const LanePointers<Record>& records) {
  static_assert(Count % 4 == 0 && sizeof(Record) >= Count * sizeof(Real));
  for (std::size_t first = 0; first < Count; first += 4)
    store_quad({fields[first], fields[first + 1], fields[first + 2], fields[first + 3]}, records, first);
}

}  // namespace sazare
