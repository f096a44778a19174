#include <gtest/gtest.h>

#include "sazare/levels/distribute/ranges.hpp"

namespace sazare::distribute {
namespace {

std::vector<Index> cuts(const Ranges& ranges) { return {ranges.cuts().begin(), ranges.cuts().end()}; }

TEST(ranges, know_who_owns_what) {
  const Ranges ranges({0, 2, 5});
  EXPECT_EQ(ranges.count(), 2);
  EXPECT_EQ(ranges.owner(1), 0);
  EXPECT_EQ(ranges.owner(2), 1);
  EXPECT_EQ(ranges.size(1), 3);
}

TEST(ranges, equal_costs_make_equal_ranges) {
  EXPECT_EQ(cuts(cut_evenly(std::vector<Real>(12, 0.7), 4)), (std::vector<Index>{0, 3, 6, 9, 12}));
}

TEST(ranges, a_dear_body_stands_alone) {
  EXPECT_EQ(cuts(cut_evenly(std::vector<Real>{1, 1, 8, 1, 1}, 3)), (std::vector<Index>{0, 2, 3, 5}));
}

TEST(ranges, no_range_is_empty_while_there_are_bodies) {
  EXPECT_EQ(cuts(cut_evenly(std::vector<Real>{0, 0, 0, 100}, 3)), (std::vector<Index>{0, 2, 3, 4}));
  EXPECT_EQ(cuts(cut_evenly(std::vector<Real>{100, 0, 0, 0}, 3)), (std::vector<Index>{0, 1, 2, 4}));
}

TEST(ranges, more_ranks_than_bodies_leave_some_without) {
  const Ranges ranges = cut_evenly(std::vector<Real>(2, 1), 4);
  EXPECT_EQ(ranges.count(), 4);
  EXPECT_EQ(ranges.end(3), 2);
}

}  // namespace
}  // namespace sazare::distribute
