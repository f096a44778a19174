#include "sazare/core/exact_vector.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "sazare/core/memory_archive.hpp"

namespace sazare {
namespace {

ExactSum sum_of(const std::vector<Real>& numbers) {
  ExactSum sum;
  for (const Real number : numbers) sum += number;
  return sum;
}

ExactSum through_checkpoint(ExactSum sum) {
  MemoryArchive archive;
  exact_column(archive, "sum", sum);
  archive.turn_round();
  ExactSum read = sum_of({17});
  exact_column(archive, "sum", read);
  return read;
}

TEST(exact_vector, has_the_sums_of_its_axes) {
  ExactVector some, more, all;
  some += Vector3(1, 1e-20, 1e300);
  more += Vector3(-1, 1e20, 1e-300);
  all += more;
  all += some;
  all += Vector3(1e-30, -1e20, -1e300);
  EXPECT_EQ(all.value(), Vector3(1e-30, 1e-20, 1e-300));
}

TEST(exact_parts, are_the_same_for_the_same_sum) {
  const std::vector<Real> parts = exact_parts(sum_of({1e300, 1, -3e-20, 1e-300, 0.1, -1}));
  EXPECT_EQ(parts, exact_parts(sum_of({0.1, 1e-300, -3e-20, 1e300})));
  EXPECT_EQ(parts.front(), 1e300);
  EXPECT_TRUE(exact_parts(sum_of({0.1, -0.1})).empty());
}

TEST(exact_column, keeps_all_of_a_sum) {
  const std::vector<Real> numbers = {1e300, -1e-300, 0.1, -1e17, 3 * std::numeric_limits<Real>::denorm_min()};
  ExactSum read = through_checkpoint(sum_of(numbers));
  EXPECT_EQ(read.value(), sum_of(numbers).value());
  for (const Real number : numbers) read -= number;
  EXPECT_EQ(read.value(), 0);
  EXPECT_EQ(through_checkpoint({}).value(), 0);
  EXPECT_TRUE(std::isnan(through_checkpoint(sum_of({1, std::numeric_limits<Real>::infinity()})).value()));
}

}  // namespace
}  // namespace sazare
