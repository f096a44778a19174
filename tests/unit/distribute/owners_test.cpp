#include <gtest/gtest.h>

#include "sazare/levels/distribute/owners.hpp"

namespace sazare::distribute {
namespace {

/// Where the ranges of owners with one range each begin, and the end.
std::vector<Index> cuts(const Owners& owners) {
  std::vector<Index> begin = {0};
  for (int rank = 0; rank < owners.ranks(); ++rank)
    begin.push_back(owners.ranges(rank).empty() ? begin.back() : owners.ranges(rank).back().end);
  return begin;
}

TEST(owners, know_who_owns_what) {
  const Owners owners({0, 0, 1, 0, 1}, 3);
  EXPECT_EQ(owners.ranks(), 3);
  EXPECT_EQ(owners.bodies(), 5);
  EXPECT_EQ(owners.owner(2), 1);
  EXPECT_EQ(owners.size(0), 3);
  EXPECT_EQ(owners.size(2), 0);
  const std::vector<BodyRange> first(owners.ranges(0).begin(), owners.ranges(0).end());
  EXPECT_EQ(first, (std::vector<BodyRange>{{0, 2}, {3, 4}}));
}

TEST(owners, equal_costs_make_equal_ranges) {
  EXPECT_EQ(cuts(cut_evenly(std::vector<Real>(12, 0.7), 4)), (std::vector<Index>{0, 3, 6, 9, 12}));
  EXPECT_TRUE(cut_equally(12, 4) == cut_evenly(std::vector<Real>(12, 0.7), 4));
}

TEST(owners, a_dear_body_stands_alone) {
  EXPECT_EQ(cuts(cut_evenly(std::vector<Real>{1, 1, 8, 1, 1}, 3)), (std::vector<Index>{0, 2, 3, 5}));
}

TEST(owners, no_rank_is_without_bodies_while_there_are_enough) {
  EXPECT_EQ(cuts(cut_evenly(std::vector<Real>{0, 0, 0, 100}, 3)), (std::vector<Index>{0, 2, 3, 4}));
  EXPECT_EQ(cuts(cut_evenly(std::vector<Real>{100, 0, 0, 0}, 3)), (std::vector<Index>{0, 1, 2, 4}));
}

TEST(owners, more_ranks_than_bodies_leave_some_without) {
  const Owners owners = cut_evenly(std::vector<Real>(2, 1), 4);
  EXPECT_EQ(owners.ranks(), 4);
  EXPECT_EQ(owners.size(2) + owners.size(3), 0);
  EXPECT_EQ(owners.size(0) + owners.size(1), 2);
}

}  // namespace
}  // namespace sazare::distribute
