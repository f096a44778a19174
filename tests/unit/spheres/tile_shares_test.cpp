#include <gtest/gtest.h>

#include "sazare/methods/spheres/stepper/tile_shares.hpp"

namespace sazare::methods::spheres {
namespace {

using Cuts = std::vector<std::size_t>;

/// What balanced cuts follow from shares that took so many seconds.
Cuts balanced(const Cuts& cuts, const std::vector<Real>& seconds) {
  TileCosts costs;
  costs.learn(cuts, seconds);
  return costs.improved(cuts);
}

TEST(tile_shares, are_even_but_for_one_tile) {
  EXPECT_EQ(even_cuts(10, 3), (Cuts{0, 3, 6, 10}));
  EXPECT_EQ(even_cuts(2, 5), (Cuts{0, 1, 2}));
  EXPECT_EQ(even_cuts(0, 2), (Cuts{0, 0}));
}

TEST(tile_shares, take_what_they_cost) {
  EXPECT_EQ(balanced({0, 10, 20}, {2, 2}), (Cuts{0, 10, 20}));
  EXPECT_EQ(balanced({0, 12, 24}, {6, 2}), (Cuts{0, 8, 24}));
  EXPECT_EQ(balanced({0, 8, 16, 24}, {1, 3, 8}), (Cuts{0, 16, 20, 24}));
}

TEST(tile_shares, keep_a_tile_each) {
  EXPECT_EQ(balanced({0, 1, 2, 4}, {100, 0, 0}), (Cuts{0, 1, 2, 4}));
  EXPECT_EQ(balanced({0, 3, 9}, {0, 0}), (Cuts{0, 3, 9}));
}

TEST(tile_shares, stay_for_a_small_gain) {
  EXPECT_EQ(balanced({0, 100, 200}, {1, 1.03}), (Cuts{0, 100, 200}));
  EXPECT_EQ(balanced({0, 100, 200}, {1, 1.06}), (Cuts{0, 103, 200}));
}

TEST(tile_shares, follow_slowly_what_one_measurement_says) {
  TileCosts costs;
  const Cuts cuts{0, 100, 200};
  costs.learn(cuts, std::vector<Real>{1, 1});
  costs.learn(cuts, std::vector<Real>{3, 1});  // counts as 2 and 1
  EXPECT_EQ(costs.improved(cuts), (Cuts{0, 75, 200}));
}

TEST(tile_shares, learn_anew_where_there_are_other_tiles) {
  TileCosts costs;
  costs.learn({0, 100, 200}, std::vector<Real>{5, 1});
  costs.learn({0, 10, 20}, std::vector<Real>{1, 1});
  EXPECT_EQ(costs.tiles(), 20);
  EXPECT_EQ(costs.improved({0, 10, 20}), (Cuts{0, 10, 20}));
}

}  // namespace
}  // namespace sazare::methods::spheres
