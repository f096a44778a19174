#pragma once

/// A sum that does not depend on the order of what is added, nor on how it is shared out: it is kept without any rounding.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sazare/core/vector.hpp"

namespace sazare {

/// A number of 2100 binary digits in pieces of 32, each with room for carries (Kulisch's accumulator; Neal, arXiv:1505.05571).
/// Infinities and what is no number turn the sum into one that is no number. What is near to 1, from 2^-30 to 2^30, is added to
/// one integer first, which takes fewer instructions.
class ExactSum {
public:
  ExactSum& operator+=(Real x) {
    add(x, 1);
    return *this;
  }
  ExactSum& operator-=(Real x) {
    add(x, -1);
    return *this;
  }
  ExactSum& operator+=(const ExactSum& other) {
    ExactSum carried = other;
    carried.carry();
    carry();
    for (std::size_t i = 0; i < piece_count; ++i) pieces_[i] += carried.pieces_[i];
    invalid_ = invalid_ || other.invalid_;
    return *this;
  }

  /// Adds count times 2^exponent, an exponent from -1074 on.
  void add_multiple(std::int64_t count, int exponent) {
    const auto place = static_cast<std::uint32_t>(exponent + unit);
    const Wide number = static_cast<Wide>(count) << place % 32;
    std::int64_t* const piece = pieces_.data() + place / 32;
    piece[0] += static_cast<std::int64_t>(static_cast<std::uint64_t>(number) & low);
    piece[1] += static_cast<std::int64_t>(static_cast<std::uint64_t>(number >> 32) & low);
    piece[2] += static_cast<std::int64_t>(number >> 64);
    if (++additions_ == most_additions) carry();
  }

  /// The sum, rounded to within one unit of the last digit.
  Real value() const {
    if (invalid_) return std::nan("");
    ExactSum whole = *this;
    whole.carry();
    const bool negative = whole.pieces_.back() < 0;
    if (negative) {
      for (std::int64_t& piece : whole.pieces_) piece = -piece;
      whole.carry();
    }
    Real sum = 0;
    for (std::size_t i = piece_count; i-- > 0;)
      if (whole.pieces_[i] != 0) sum += std::ldexp(static_cast<Real>(whole.pieces_[i]), 32 * static_cast<int>(i) - unit);
    return negative ? -sum : sum;
  }

private:
  static constexpr std::size_t piece_count = 67;  // 2046 exponents and 53 digits reach into the 66th; the last has the sign
  static constexpr int unit = 1074;               // the smallest number is 2^-1074
  static constexpr std::int64_t most_additions = 1 << 29;  // an addition adds less than 2^33 to a piece
  static constexpr std::uint64_t low = 0xffffffff;
  static constexpr std::uint32_t near_piece = 31, near_place = 32 * near_piece, near_places = 60;
  static constexpr std::int64_t most_near_additions = 1 << 13;  // of less than 2^113 each

  __extension__ using Wide = __int128;

  void add(Real x, std::int64_t sign) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const auto exponent = static_cast<std::uint32_t>(bits >> 52 & 0x7ff);
    std::uint64_t digits = bits & ((std::uint64_t{1} << 52) - 1);
    if (const std::uint32_t nearness = exponent - 1 - near_place; nearness < near_places) {
      const Wide number = static_cast<Wide>(digits | std::uint64_t{1} << 52) << nearness;
      near_ += (sign < 0) != (bits >> 63 != 0) ? -number : number;
      if (++near_additions_ == most_near_additions) gather_near();
      return;
    }
    if (exponent == 0x7ff) invalid_ = true;
    if (exponent > 0) digits |= std::uint64_t{1} << 52;
    if (digits == 0 || invalid_) return;
    const std::uint32_t place = exponent > 0 ? exponent - 1 : 0, shift = place % 32;
    if ((bits >> 63) != 0) sign = -sign;
    const std::uint64_t lower = (digits & low) << shift, upper = (digits >> 32) << shift;
    std::int64_t* const piece = pieces_.data() + place / 32;
    piece[0] += sign * static_cast<std::int64_t>(lower & low);
    piece[1] += sign * static_cast<std::int64_t>((lower >> 32) + (upper & low));
    piece[2] += sign * static_cast<std::int64_t>(upper >> 32);
    if (++additions_ == most_additions) carry();
  }

  void gather_near() {
    for (std::uint32_t i = 0; i < 3; ++i)
      pieces_[near_piece + i] += static_cast<std::int64_t>(static_cast<std::uint64_t>(near_ >> 32 * i) & low);
    pieces_[near_piece + 3] += static_cast<std::int64_t>(near_ >> 96);
    near_ = 0;
    near_additions_ = 0;
    if (++additions_ == most_additions) carry();
  }

  /// Brings all pieces but the last into 0..2^32.
  void carry() {
    if (near_additions_ > 0) gather_near();
    for (std::size_t i = 0; i + 1 < piece_count; ++i) {
      pieces_[i + 1] += pieces_[i] >> 32;
      pieces_[i] &= static_cast<std::int64_t>(low);
    }
    additions_ = 0;
  }

  std::array<std::int64_t, piece_count> pieces_{};
  Wide near_ = 0;                    ///< in units of 2^-1074 2^near_place
  std::int64_t near_additions_ = 0;  ///< since it was gathered
  std::int64_t additions_ = 0;       ///< since the last carry
  bool invalid_ = false;
};

}  // namespace sazare
