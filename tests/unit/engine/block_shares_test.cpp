#include "sazare/engine/block_shares.hpp"

#include <gtest/gtest.h>

namespace sazare::engine {
namespace {

using Cuts = std::vector<std::size_t>;

TEST(block_shares, are_even_but_for_one_block) {
  EXPECT_EQ(even_cuts(10, 3), (Cuts{0, 3, 6, 10}));
  EXPECT_EQ(even_cuts(2, 5), (Cuts{0, 1, 2}));
  EXPECT_EQ(even_cuts(0, 2), (Cuts{0, 0}));
}

TEST(block_shares, take_what_they_cost) {
  const std::vector<Real> alike{2, 2}, slow_first{6, 2}, slow_last{1, 3, 8};
  EXPECT_EQ(balanced_cuts({0, 10, 20}, alike), (Cuts{0, 10, 20}));
  EXPECT_EQ(balanced_cuts({0, 12, 24}, slow_first), (Cuts{0, 8, 24}));
  EXPECT_EQ(balanced_cuts({0, 8, 16, 24}, slow_last), (Cuts{0, 16, 20, 24}));
}

TEST(block_shares, keep_a_block_each) {
  const std::vector<Real> one_costs_all{100, 0, 0}, nothing{0, 0};
  EXPECT_EQ(balanced_cuts({0, 1, 2, 4}, one_costs_all), (Cuts{0, 1, 2, 4}));
  EXPECT_EQ(balanced_cuts({0, 3, 9}, nothing), (Cuts{0, 3, 9}));
}

}  // namespace
}  // namespace sazare::engine
