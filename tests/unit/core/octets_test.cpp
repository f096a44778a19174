#include "sazare/core/octets.hpp"

#include <gtest/gtest.h>

#include <array>

namespace sazare {
namespace {

using Record = std::array<Real, 8>;

Record record_of(const Octet& octet) {
  Record record{};
  octet.store(record.data());
  return record;
}

const Record one{1, -2, 3, -4, 5, 6, -7, 8}, other{10, 20, 30, 40, 50, 60, 70, 80};

TEST(octets, are_read_and_written_at_any_number) {
  std::array<Real, 10> row{};
  Octet::load(one.data()).store(&row[1]);
  EXPECT_EQ(row[0], 0);
  EXPECT_EQ(row[9], 0);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(row[1 + i], one[i]);
}

TEST(octets, are_computed_with_number_by_number) {
  const Octet a = Octet::load(one.data()), b = Octet::load(other.data());
  const Record sum = record_of(a + b), doubled = record_of(2 * a), product = record_of(add_product(a, b, a));
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(sum[i], one[i] + other[i]);
    EXPECT_EQ(doubled[i], 2 * one[i]);
    EXPECT_EQ(product[i], one[i] * other[i] + one[i]);
  }
}

TEST(octets, have_two_halves_of_a_vector_and_a_number) {
  const Octet a = Octet::load(one.data()), b = Octet::load(other.data());
  EXPECT_EQ(record_of(a.numbers()), (Record{-4, -4, -4, -4, 8, 8, 8, 8}));
  EXPECT_EQ(record_of(a.without_second_vector()), (Record{1, -2, 3, -4, 0, 0, 0, 8}));
  EXPECT_EQ(record_of(a.where_above_zero(a)), (Record{1, 0, 3, 0, 5, 6, 0, 8}));
  EXPECT_EQ(record_of(firsts(a, b)), (Record{1, -2, 3, -4, 10, 20, 30, 40}));
  EXPECT_EQ(record_of(Octet::halves(-1, 2)), (Record{-1, -1, -1, -1, 2, 2, 2, 2}));
  EXPECT_EQ(record_of(Octet(load_half(&other[4]), load_half(&one[0]))), (Record{50, 60, 70, 80, 1, -2, 3, -4}));
  std::array<Real, 4> half{};
  store_half(half.data(), with_number_of(load_half(&other[0]), a.second()));
  EXPECT_EQ(half, (std::array<Real, 4>{5, 6, -7, 40}));
}

}  // namespace
}  // namespace sazare
