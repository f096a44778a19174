#include "sazare/core/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace sazare {
namespace {

std::vector<Real> numbers_of_all_sizes() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<Real> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-300, 300);
  std::vector<Real> numbers;
  for (int i = 0; i < 2000; ++i) numbers.push_back(std::ldexp(mantissa(random), exponent(random)));
  return numbers;
}

ExactSum sum_of(std::span<const Real> numbers) {
  ExactSum sum;
  for (const Real number : numbers) sum += number;
  return sum;
}

TEST(exact_sum, is_the_number_itself_for_one) {
  for (const Real number : {0.0, 1.0, -1.0, 0.1, -1e300, 1e-300, 3 * std::numeric_limits<Real>::denorm_min(),
                            std::numeric_limits<Real>::max(), -std::numeric_limits<Real>::min()}) {
    ExactSum sum;
    sum += number;
    EXPECT_EQ(sum.value(), number);
  }
}

TEST(exact_sum, keeps_what_rounding_would_lose) {
  ExactSum sum;
  sum += 1e300;
  sum += 1e-300;
  sum -= 1e300;
  EXPECT_EQ(sum.value(), 1e-300);
  sum -= 1e-300;
  EXPECT_EQ(sum.value(), 0);
}

TEST(exact_sum, loses_nothing_of_many_numbers_near_to_one) {
  // Binary fractions with so few digits that the plain sum is exact too, of both signs and about both ends of what is near.
  for (const int scale : {-31, -30, -10, 0, 25, 29, 30}) {
    ExactSum sum;
    Real plain = 0;
    for (int n = 0; n < 20000; ++n) {
      const Real number = std::ldexp(static_cast<Real>(n % 1001 - 300) / 512, scale);
      sum += number;
      plain += number;
    }
    EXPECT_EQ(sum.value(), plain) << scale;
    sum -= plain;
    EXPECT_EQ(sum.value(), 0) << scale;
  }
}

TEST(exact_sum, has_the_same_bits_in_any_order_and_in_any_parts) {
  std::vector<Real> numbers = numbers_of_all_sizes();
  const Real expected = sum_of(numbers).value();
  EXPECT_NE(expected, 0);
  std::mt19937_64 random(11);
  for (const std::size_t cut : {std::size_t{1}, numbers.size() / 3, numbers.size() - 1}) {
    std::ranges::shuffle(numbers, random);
    ExactSum first = sum_of(std::span(numbers).first(cut));
    first += sum_of(std::span(numbers).subspan(cut));
    EXPECT_EQ(first.value(), expected);
  }
}

TEST(exact_sum, is_within_a_unit_of_the_last_digit) {
  ExactSum sum;
  for (int i = 1; i <= 100000; ++i) sum += 0.1;
  EXPECT_DOUBLE_EQ(sum.value(), 10000.0000000000005551);  // a hundred thousand times the double next to 0.1
  for (int i = 1; i <= 200000; ++i) sum -= 0.1;
  EXPECT_DOUBLE_EQ(sum.value(), -10000.0000000000005551);
}

TEST(exact_sum, of_what_is_no_number_is_none) {
  ExactSum sum;
  sum += std::numeric_limits<Real>::infinity();
  sum += 1;
  EXPECT_TRUE(std::isnan(sum.value()));
  ExactSum other;
  other += sum;
  EXPECT_TRUE(std::isnan(other.value()));
}

}  // namespace
}  // namespace sazare
