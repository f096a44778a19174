#include "sazare/parallel/sort.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace sazare::parallel {
namespace {

class Sort : public testing::TestWithParam<int> {
protected:
  void SetUp() override { set_threads(GetParam()); }
  void TearDown() override { set_threads(0); }
};

TEST_P(Sort, puts_all_in_order) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, std::size_t{50021}}) {
    std::vector<std::uint64_t> numbers(count);
    std::uint64_t number = 1;
    for (std::uint64_t& one : numbers) one = (number = number * 6364136223846793005ULL + 1442695040888963407ULL) >> 40;
    std::vector<std::uint64_t> expected = numbers;
    std::ranges::sort(expected);
    sort(numbers);
    EXPECT_EQ(numbers, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(on_threads, Sort, testing::Values(1, 2, 3, 4, 7));

}  // namespace
}  // namespace sazare::parallel
