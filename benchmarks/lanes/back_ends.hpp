#pragma once

/// The vectors of three libraries under one interface: those of `core/lanes.hpp`, of std::experimental::simd and of Highway.
/// Kernels are templates of a back end and call nothing else. For processors with AVX-512, where all three hold eight numbers.
///
/// What a library lacks it may take from the intrinsics of the processor, as its `Extras` say. Without them it does everything in
/// its own way.

#include <hwy/highway.h>
#include <immintrin.h>

#include <array>
#include <cstddef>
#include <experimental/simd>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/twin_lanes.hpp"

namespace sazare::bench {

enum class Extras {
  none,
  root,  ///< reciprocal roots from an estimate
  all    ///< these, shuffles that turn records into lanes, and products that are added and rounded once
};

inline constexpr std::size_t width = 8;
static_assert(lane_count == width, "this benchmark is for AVX-512");

/// The vectors of the engine; the other back ends take its operations where intrinsics are allowed.
struct OwnOps {
  static constexpr const char* name = "core/lanes.hpp";
  using Vector = Lanes;
  using Mask = LaneMask;

  static Vector broadcast(Real value) { return sazare::broadcast(value); }
  static Vector load(const Real* from) { return load_lanes(from); }
  static void store(Real* to, Vector v) { store_lanes(to, v); }
  static Vector halves(const Real* low, const Real* high) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(low)), _mm256_loadu_pd(high), 1);
  }
  static Vector add_product(Vector a, Vector b, Vector c) { return sazare::add_product(a, b, c); }
  static Vector subtract_product(Vector a, Vector b, Vector c) { return sazare::subtract_product(a, b, c); }
  static Vector maximum(Vector a, Vector b) { return sazare::maximum(a, b); }
  static Vector square_root(Vector a) { return sazare::square_root(a); }
  static Vector inverse_square_root(Vector a) { return sazare::inverse_square_root(a); }
  static Vector select(Mask mask, Vector yes, Vector no) { return sazare::select(mask, yes, no); }
  static bool any(Mask mask) { return sazare::any(mask); }
  static void transpose(std::array<Vector, width>& rows) { sazare::transpose(rows); }
  /// Four numbers of each of eight records; `from` says where they stand.
  template <class From>
  static std::array<Vector, 4> quads(const From& from) {
    return load_quads(from);
  }
};

namespace stdx = std::experimental;

template <Extras extras>
struct StandardOps {
  static constexpr const char* name = extras == Extras::all    ? "std::experimental::simd, root and shuffles ours"
                                      : extras == Extras::root ? "std::experimental::simd, root ours"
                                                               : "std::experimental::simd alone";
  using Vector = stdx::native_simd<Real>;
  using Mask = Vector::mask_type;
  static_assert(Vector::size() == width);

  static __m512d raw(Vector v) { return static_cast<__m512d>(v); }
  static Vector of(__m512d v) { return Vector(v); }

  static Vector broadcast(Real value) { return Vector(value); }
  static Vector load(const Real* from) { return Vector(from, stdx::element_aligned); }
  static void store(Real* to, Vector v) { v.copy_to(to, stdx::element_aligned); }
  static Vector add_product(Vector a, Vector b, Vector c) {
    if constexpr (extras == Extras::all) return of(_mm512_fmadd_pd(raw(a), raw(b), raw(c)));
    return a * b + c;  // std::experimental::fma of GCC 12 works number by number
  }
  static Vector subtract_product(Vector a, Vector b, Vector c) {
    if constexpr (extras == Extras::all) return of(_mm512_fnmadd_pd(raw(a), raw(b), raw(c)));
    return c - a * b;
  }
  static Vector maximum(Vector a, Vector b) { return stdx::max(a, b); }
  static Vector square_root(Vector a) { return stdx::sqrt(a); }
  static Vector inverse_square_root(Vector a) {
    if constexpr (extras != Extras::none) return of(OwnOps::inverse_square_root(raw(a)));
    return 1.0 / stdx::sqrt(a);
  }
  static Vector select(Mask mask, Vector yes, Vector no) {
    stdx::where(mask, no) = yes;
    return no;
  }
  static bool any(Mask mask) { return stdx::any_of(mask); }
  static void transpose(std::array<Vector, width>& rows) {
    if constexpr (extras == Extras::all) {
      std::array<Lanes, width> all;
      for (std::size_t i = 0; i < width; ++i) all[i] = raw(rows[i]);
      OwnOps::transpose(all);
      for (std::size_t i = 0; i < width; ++i) rows[i] = of(all[i]);
    } else {  // the library moves no number from lane to lane: through memory
      alignas(64) Real numbers[width][width];
      for (std::size_t i = 0; i < width; ++i) rows[i].copy_to(numbers[i], stdx::vector_aligned);
      for (std::size_t i = 0; i < width; ++i) rows[i] = Vector([&](auto lane) { return numbers[lane][i]; });
    }
  }
  template <class From>
  static std::array<Vector, 4> quads(const From& from) {
    std::array<Vector, 4> fields;
    if constexpr (extras == Extras::all) {
      const auto all = OwnOps::quads(from);
      for (std::size_t i = 0; i < 4; ++i) fields[i] = of(all[i]);
    } else {
      for (std::size_t i = 0; i < 4; ++i) fields[i] = Vector([&](auto lane) { return from(lane)[i]; });
    }
    return fields;
  }
};

namespace hn = hwy::HWY_NAMESPACE;

template <Extras extras>
struct HighwayOps {
  static constexpr const char* name = extras == Extras::all    ? "Highway, root and shuffles ours"
                                      : extras == Extras::root ? "Highway, root ours"
                                                               : "Highway alone";
  using Tag = hn::FixedTag<Real, width>;
  using Vector = hn::Vec<Tag>;
  using Mask = hn::Mask<Tag>;
  static constexpr Tag tag{};

  static Vector of(__m512d v) { return Vector{v}; }

  static Vector broadcast(Real value) { return hn::Set(tag, value); }
  static Vector load(const Real* from) { return hn::LoadU(tag, from); }
  static void store(Real* to, Vector v) { hn::StoreU(v, tag, to); }
  static Vector add_product(Vector a, Vector b, Vector c) { return hn::MulAdd(a, b, c); }
  static Vector subtract_product(Vector a, Vector b, Vector c) { return hn::NegMulAdd(a, b, c); }
  static Vector maximum(Vector a, Vector b) { return hn::Max(a, b); }
  static Vector square_root(Vector a) { return hn::Sqrt(a); }
  static Vector inverse_square_root(Vector a) {
    if constexpr (extras != Extras::none) return of(OwnOps::inverse_square_root(a.raw));
    return hn::Div(broadcast(1), hn::Sqrt(a));  // an estimate there is for single precision alone
  }
  static Vector select(Mask mask, Vector yes, Vector no) { return hn::IfThenElse(mask, yes, no); }
  static bool any(Mask mask) { return !hn::AllFalse(tag, mask); }

  /// Blocks 0 and 2 of two vectors, a0 b0 a2 b2, and blocks 1 and 3: Highway has no shuffle of blocks of two vectors.
  static Vector even_blocks(Vector a, Vector b) { return hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a); }
  static Vector odd_blocks(Vector a, Vector b) { return hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a)); }
  static void transpose(std::array<Vector, width>& rows) {
    if constexpr (extras == Extras::all) {
      std::array<Lanes, width> all;
      for (std::size_t i = 0; i < width; ++i) all[i] = rows[i].raw;
      OwnOps::transpose(all);
      for (std::size_t i = 0; i < width; ++i) rows[i] = of(all[i]);
    } else {
      std::array<Vector, 4> even, odd;
      for (std::size_t i = 0; i < 4; ++i) {
        even[i] = hn::InterleaveLower(tag, rows[2 * i], rows[2 * i + 1]);
        odd[i] = hn::InterleaveUpper(tag, rows[2 * i], rows[2 * i + 1]);
      }
      const auto turn = [&](const std::array<Vector, 4>& pairs, std::size_t to) {
        const Vector a = even_blocks(pairs[0], pairs[1]), b = odd_blocks(pairs[0], pairs[1]), c = even_blocks(pairs[2], pairs[3]),
                     d = odd_blocks(pairs[2], pairs[3]);
        rows[to] = hn::ConcatLowerLower(tag, c, a);
        rows[to + 2] = hn::ConcatLowerLower(tag, d, b);
        rows[to + 4] = hn::ConcatUpperUpper(tag, c, a);
        rows[to + 6] = hn::ConcatUpperUpper(tag, d, b);
      };
      turn(even, 0);
      turn(odd, 1);
    }
  }
  template <class From>
  static std::array<Vector, 4> quads(const From& from) {
    if constexpr (extras == Extras::all) {
      const auto all = OwnOps::quads(from);
      return {of(all[0]), of(all[1]), of(all[2]), of(all[3])};
    } else {
      const hn::Half<Tag> half;
      const auto halves = [&](std::size_t lane) {
        return hn::Combine(tag, hn::LoadU(half, from(lane + 4)), hn::LoadU(half, from(lane)));
      };
      const Vector zero = halves(0), one = halves(1), two = halves(2), three = halves(3);
      const Vector even = hn::InterleaveLower(tag, zero, one), odd = hn::InterleaveUpper(tag, zero, one),
                   even2 = hn::InterleaveLower(tag, two, three), odd2 = hn::InterleaveUpper(tag, two, three);
      return {even_blocks(even, even2), even_blocks(odd, odd2), odd_blocks(even, even2), odd_blocks(odd, odd2)};
    }
  }
};

/// A vector of a back end as a number of the laws.
template <class Ops>
struct Number {
  typename Ops::Vector v;

  Number() : v(Ops::broadcast(0)) {}
  Number(typename Ops::Vector vector) : v(vector) {}  // NOLINT(google-explicit-constructor): as numbers are
  Number(Real value) : v(Ops::broadcast(value)) {}    // NOLINT(google-explicit-constructor)

  friend Number operator-(const Number& a) { return Number() - a; }
  friend Number operator+(const Number& a, const Number& b) { return a.v + b.v; }
  friend Number operator-(const Number& a, const Number& b) { return a.v - b.v; }
  friend Number operator*(const Number& a, const Number& b) { return a.v * b.v; }
  friend Number operator/(const Number& a, const Number& b) { return a.v / b.v; }
  Number& operator+=(const Number& a) { return *this = *this + a; }
  Number& operator-=(const Number& a) { return *this = *this - a; }

  struct Mask {
    typename Ops::Mask m;
    friend bool any(const Mask& mask) { return Ops::any(mask.m); }
  };
  friend Mask operator>(const Number& a, const Number& b) { return {a.v > b.v}; }
  friend Mask operator<(const Number& a, const Number& b) { return {a.v < b.v}; }

  friend Number add_product(const Number& a, const Number& b, const Number& c) { return Ops::add_product(a.v, b.v, c.v); }
  friend Number subtract_product(const Number& a, const Number& b, const Number& c) {
    return Ops::subtract_product(a.v, b.v, c.v);
  }
  friend Number maximum(const Number& a, const Number& b) { return Ops::maximum(a.v, b.v); }
  friend Number square_root(const Number& a) { return Ops::square_root(a.v); }
  friend Number inverse_square_root(const Number& a) { return Ops::inverse_square_root(a.v); }
  friend Number root_of_quotient(const Number& a, const Number& b) { return a * inverse_square_root(a * b); }
  friend Number select(const Mask& mask, const Number& yes, const Number& no) { return Ops::select(mask.m, yes.v, no.v); }
  friend bool any_above(const Number& a, const Number& b) { return any(a > b); }
};

/// Two of them worked on side by side, as in core/twin_lanes.hpp.
template <class Ops>
struct Twins {
  using Half = Number<Ops>;
  Half first, second;

  Twins() = default;
  Twins(const Half& one, const Half& other) : first(one), second(other) {}
  Twins(Real value) : first(value), second(value) {}  // NOLINT(google-explicit-constructor): as numbers are

  friend Twins operator-(const Twins& a) { return {-a.first, -a.second}; }
  friend Twins operator+(const Twins& a, const Twins& b) { return {a.first + b.first, a.second + b.second}; }
  friend Twins operator-(const Twins& a, const Twins& b) { return {a.first - b.first, a.second - b.second}; }
  friend Twins operator*(const Twins& a, const Twins& b) { return {a.first * b.first, a.second * b.second}; }
  friend Twins operator/(const Twins& a, const Twins& b) { return {a.first / b.first, a.second / b.second}; }
  Twins& operator+=(const Twins& a) { return *this = *this + a; }
  Twins& operator-=(const Twins& a) { return *this = *this - a; }

  struct Mask {
    typename Half::Mask first, second;
  };
  friend Mask operator>(const Twins& a, const Twins& b) { return {a.first > b.first, a.second > b.second}; }

  friend Twins add_product(const Twins& a, const Twins& b, const Twins& c) {
    return {add_product(a.first, b.first, c.first), add_product(a.second, b.second, c.second)};
  }
  friend Twins subtract_product(const Twins& a, const Twins& b, const Twins& c) {
    return {subtract_product(a.first, b.first, c.first), subtract_product(a.second, b.second, c.second)};
  }
  friend Twins maximum(const Twins& a, const Twins& b) { return {maximum(a.first, b.first), maximum(a.second, b.second)}; }
  friend Twins inverse_square_root(const Twins& a) { return {inverse_square_root(a.first), inverse_square_root(a.second)}; }
  /// By the reciprocal root, as the engine takes it of two vectors.
  friend Twins square_root(const Twins& a) { return select(a > 0, a * inverse_square_root(a), a); }
  friend Twins root_of_quotient(const Twins& a, const Twins& b) {
    return {root_of_quotient(a.first, b.first), root_of_quotient(a.second, b.second)};
  }
  friend Twins select(const Mask& mask, const Twins& yes, const Twins& no) {
    return {select(mask.first, yes.first, no.first), select(mask.second, yes.second, no.second)};
  }
  friend bool any_above(const Twins& a, const Twins& b) { return any_above(a.first, b.first) || any_above(a.second, b.second); }
};

}  // namespace sazare::bench
