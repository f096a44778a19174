#pragma once

/// A fast hash of bytes (XXH64, Yann Collet's xxHash), for the state of a run and the blobs of a checkpoint.
/// It finds differences and damage; it does not withstand an adversary.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace sazare::observe {

namespace detail {

inline constexpr std::uint64_t prime_1 = 0x9E3779B185EBCA87ULL;
inline constexpr std::uint64_t prime_2 = 0xC2B2AE3D27D4EB4FULL;
inline constexpr std::uint64_t prime_3 = 0x165667B19E3779F9ULL;
inline constexpr std::uint64_t prime_4 = 0x85EBCA77C2B2AE63ULL;
inline constexpr std::uint64_t prime_5 = 0x27D4EB2F165667C5ULL;

template <class T>
T load(const std::byte* bytes) {
  static_assert(std::endian::native == std::endian::little, "hashes would differ from those of other machines");
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

inline std::uint64_t mixed(std::uint64_t lane, std::uint64_t input) { return std::rotl(lane + input * prime_2, 31) * prime_1; }

inline std::uint64_t merged(std::uint64_t hash, std::uint64_t lane) { return (hash ^ mixed(0, lane)) * prime_1 + prime_4; }

/// The last bytes, fewer than 32, and the avalanche.
inline std::uint64_t finished(std::uint64_t hash, const std::byte* bytes, std::size_t count) {
  for (; count >= 8; bytes += 8, count -= 8) {
    hash = std::rotl(hash ^ mixed(0, load<std::uint64_t>(bytes)), 27) * prime_1 + prime_4;
  }
  if (count >= 4) {
    hash = std::rotl(hash ^ (load<std::uint32_t>(bytes) * prime_1), 23) * prime_2 + prime_3;
    bytes += 4;
    count -= 4;
  }
  for (; count > 0; ++bytes, --count) {
    hash = std::rotl(hash ^ (static_cast<std::uint64_t>(*bytes) * prime_5), 11) * prime_1;
  }
  hash = (hash ^ (hash >> 33)) * prime_2;
  hash = (hash ^ (hash >> 29)) * prime_3;
  return hash ^ (hash >> 32);
}

}  // namespace detail

/// The hash of bytes that come in pieces, whatever the pieces; another seed gives another hash.
class PieceHash {
public:
  explicit PieceHash(std::uint64_t seed = 0)
      : seed_(seed), lanes_{seed + detail::prime_1 + detail::prime_2, seed + detail::prime_2, seed, seed - detail::prime_1} {}

  void add(std::span<const std::byte> piece) {
    total_ += piece.size();
    if (kept_ > 0) {
      const std::size_t taken = std::min(block - kept_, piece.size());
      std::copy_n(piece.begin(), taken, rest_.begin() + static_cast<std::ptrdiff_t>(kept_));
      kept_ += taken;
      piece = piece.subspan(taken);
      if (kept_ < block) return;
      mix(lanes_, rest_.data());
      kept_ = 0;
    }
    auto lanes = lanes_;  // in registers
    for (; piece.size() >= block; piece = piece.subspan(block)) mix(lanes, piece.data());
    lanes_ = lanes;
    std::copy(piece.begin(), piece.end(), rest_.begin());
    kept_ = piece.size();
  }

  std::uint64_t value() const {
    std::uint64_t hash = seed_ + detail::prime_5;
    if (total_ >= block) {
      hash = std::rotl(lanes_[0], 1) + std::rotl(lanes_[1], 7) + std::rotl(lanes_[2], 12) + std::rotl(lanes_[3], 18);
      for (const std::uint64_t lane : lanes_) hash = detail::merged(hash, lane);
    }
    return detail::finished(hash + total_, rest_.data(), kept_);
  }

private:
  static constexpr std::size_t block = 32;

  static void mix(std::array<std::uint64_t, 4>& lanes, const std::byte* bytes) {
    for (std::uint64_t& lane : lanes) {
      lane = detail::mixed(lane, detail::load<std::uint64_t>(bytes));
      bytes += 8;
    }
  }

  std::uint64_t seed_;
  std::array<std::uint64_t, 4> lanes_;
  std::array<std::byte, block> rest_{};  ///< of a block that is not yet whole
  std::size_t kept_ = 0;
  std::size_t total_ = 0;
};

/// The hash of some bytes.
inline std::uint64_t hash_bytes(std::span<const std::byte> input, std::uint64_t seed = 0) {
  PieceHash hash(seed);
  hash.add(input);
  return hash.value();
}

/// The hash of several parts in their order; where one part ends and the next begins counts as well.
class Hash {
public:
  void add(std::span<const std::byte> part) { value_ = hash_bytes(part, value_); }

  /// A part that `make` adds to a PieceHash, piece by piece.
  template <class Make>
  void add_pieces(Make&& make) {
    PieceHash part(value_);
    make(part);
    value_ = part.value();
  }

  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 0;
};

/// Sixteen hexadecimal digits.
inline std::string to_hex(std::uint64_t value) {
  std::string digits(16, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, value >>= 4) {
    *digit = "0123456789abcdef"[value & 15];
  }
  return digits;
}

}  // namespace sazare::observe
