#include "sazare/observe/hash.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string_view>
#include <vector>

namespace sazare::observe {
namespace {

std::uint64_t hash(std::string_view text, std::uint64_t seed = 0) {
  return hash_bytes(std::as_bytes(std::span(text.data(), text.size())), seed);
}

TEST(hash, agrees_with_published_values_of_xxh64) {
  EXPECT_EQ(to_hex(hash("")), "ef46db3751d8e999");
  EXPECT_EQ(to_hex(hash("a")), "d24ec4f1a98c6e5b");
  EXPECT_EQ(to_hex(hash("abc")), "44bc2cf5ad770999");
  EXPECT_EQ(to_hex(hash("Nobody inspects the spammish repetition")), "fbcea83c8a378bf1");
}

TEST(hash, every_bit_of_every_length_counts) {
  std::set<std::uint64_t> seen;
  std::size_t expected = 0;
  for (std::size_t length = 0; length < 80; ++length) {
    std::string text(length, 'x');
    seen.insert(hash(text));
    ++expected;
    for (std::size_t i = 0; i < length; ++i) {
      for (int bit = 0; bit < 8; ++bit) {
        std::string changed = text;
        changed[i] = static_cast<char>(changed[i] ^ (1 << bit));
        seen.insert(hash(changed));
        ++expected;
      }
    }
  }
  EXPECT_EQ(seen.size(), expected);
}

TEST(hash, seed_counts) { EXPECT_NE(hash("abc", 1), hash("abc", 2)); }

TEST(hash, parts_count_with_their_order_and_their_bounds) {
  const auto of_parts = [](const std::vector<std::string>& parts) {
    Hash result;
    for (const auto& part : parts) result.add(std::as_bytes(std::span(part)));
    return result.value();
  };
  EXPECT_EQ(of_parts({"ab", "c"}), of_parts({"ab", "c"}));
  EXPECT_NE(of_parts({"ab", "c"}), of_parts({"a", "bc"}));
  EXPECT_NE(of_parts({"ab", "c"}), of_parts({"c", "ab"}));
  EXPECT_NE(of_parts({"ab", ""}), of_parts({"ab"}));
}

TEST(hash, pieces_do_not_matter) {
  std::string text;
  for (int i = 0; i < 200; ++i) text += static_cast<char>(37 * i);
  const std::span bytes = std::as_bytes(std::span(text));
  for (std::size_t size = 1; size < 70; ++size) {
    PieceHash whole(7);
    Hash part;
    part.add_pieces([&](PieceHash& hash) {
      for (std::size_t first = 0; first < bytes.size(); first += size) {
        const auto piece = bytes.subspan(first, std::min(size, bytes.size() - first));
        whole.add(piece);
        hash.add(piece);
      }
    });
    EXPECT_EQ(whole.value(), hash_bytes(bytes, 7)) << size;
    EXPECT_EQ(part.value(), hash_bytes(bytes)) << size;
  }
}

TEST(hash, hex_has_sixteen_digits) {
  EXPECT_EQ(to_hex(0), "0000000000000000");
  EXPECT_EQ(to_hex(0x0123456789abcdefULL), "0123456789abcdef");
  EXPECT_EQ(to_hex(~0ULL), "ffffffffffffffff");
}

}  // namespace
}  // namespace sazare::observe
