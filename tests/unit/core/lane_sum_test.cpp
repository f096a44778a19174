#include "sazare/core/lane_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace sazare {
namespace {

/// Numbers whose exponents lie within so much of another.
std::vector<Real> numbers_around(int exponent, int within, int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<Real> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponents(exponent - within, exponent + within);
  std::vector<Real> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(std::ldexp(mantissa(random), exponents(random)));
  return numbers;
}

ExactSum one_by_one(std::span<const Real> numbers) {
  ExactSum sum;
  for (const Real number : numbers) sum += number;
  return sum;
}

ExactSum in_lanes(std::span<const Real> numbers) {
  ExactSum sum;
  add_all(numbers, sum);
  return sum;
}

TEST(lane_sum, is_that_of_the_numbers_one_by_one) {
  for (const int exponent : {0, 20, 31, 34, -20, -66, -100, -130, -170, -600, 600})
    for (const int within : {0, 5, 200}) {
      const std::vector<Real> numbers = numbers_around(exponent, within, 5003);  // more than are counted without a carry
      EXPECT_EQ(in_lanes(numbers).value(), one_by_one(numbers).value()) << exponent << " within " << within;
    }
}

TEST(lane_sum, counts_the_largest_numbers_without_loss) {
  const std::vector<Real> numbers(20000, std::nextafter(0x1p33, 0));
  EXPECT_EQ(in_lanes(numbers).value(), one_by_one(numbers).value());
  const std::vector<Real> negative(20000, -std::nextafter(0x1p33, 0));
  EXPECT_EQ(in_lanes(negative).value(), one_by_one(negative).value());
}

TEST(lane_sum, leaves_nothing_of_what_is_taken_back) {
  const std::vector<Real> numbers = numbers_around(0, 40, 1000);
  ExactSum sum = in_lanes(numbers);
  {
    LaneSum lanes(sum);
    for (std::size_t first = 0; first < numbers.size(); first += lane_count)
      lanes -= load_some(std::span(numbers).subspan(first));
  }
  EXPECT_EQ(sum.value(), 0);
}

TEST(lane_sum, of_what_is_no_number_is_none) {
  for (const Real wrong : {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity()})
    EXPECT_TRUE(std::isnan(in_lanes(std::vector<Real>{1, 2, wrong, 4}).value()));
}

}  // namespace
}  // namespace sazare
