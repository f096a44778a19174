#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sazare/levels/distribute/balance.hpp"

namespace sazare::distribute {
namespace {

constexpr Index bodies = 1000;

/// What bodies really cost: the first tenth thirty times the rest, as around a hole.
std::vector<Real> true_costs() {
  std::vector<Real> costs(bodies, 1e-6);
  std::fill_n(costs.begin(), bodies / 10, 30e-6);
  return costs;
}

Real cost_of(const Owners& owners, int rank) {
  const auto costs = true_costs();
  Real sum = 0;
  for (const BodyRange& range : owners.ranges(rank))
    sum = std::accumulate(costs.begin() + range.begin, costs.begin() + range.end, sum);
  return sum;
}

std::vector<Work> work_of(const Owners& owners) {
  std::vector<Work> work;
  for (int rank = 0; rank < owners.ranks(); ++rank) work.push_back({{cost_of(owners, rank)}, {owners.size(rank)}});
  return work;
}

Outlook outlook_of(const std::vector<Real>& due) { return {{due}, {}}; }

/// Largest over smallest cost after some intervals.
Real imbalance_after(Policy policy, int intervals, const std::vector<Real>& due) {
  Balance balance(policy);
  Owners owners = cut_equally(bodies, 4);
  for (int interval = 0; interval < intervals; ++interval) owners = balance.next(owners, work_of(owners), outlook_of(due));
  Real smallest = 1e9, largest = 0;
  for (int rank = 0; rank < owners.ranks(); ++rank) {
    smallest = std::min(smallest, cost_of(owners, rank));
    largest = std::max(largest, cost_of(owners, rank));
  }
  return largest / smallest;
}

TEST(balance, fixed_owners_stay) { EXPECT_NEAR(imbalance_after(Policy::fixed, 5, {}), (3000 + 150.0) / 250, 1e-9); }

TEST(balance, measured_times_make_ranges_of_equal_cost) { EXPECT_LT(imbalance_after(Policy::measured, 12, {}), 1.5); }

/// 4 ranks of 250 bodies took 3150, 250, 250 and 250: a quarter of that are 77.38 bodies of the first, twice and three times as
/// many, and the last takes what is left.
TEST(balance, as_printed_cuts_at_equal_shares_of_the_last_interval) {
  Balance balance(Policy::printed);
  Owners owners = balance.next(cut_equally(bodies, 4), work_of(cut_equally(bodies, 4)), {});
  EXPECT_EQ(owners.size(0), 77);
  EXPECT_EQ(owners.size(1), 78);
  EXPECT_EQ(owners.size(2), 77);
  EXPECT_EQ(owners.size(3), bodies - 232);
  // Noise of the clock moves cuts, and an interval without work none.
  auto work = std::vector<Work>(4, {{1}, {1}});
  work[1].seconds[0] = 1.01;
  EXPECT_FALSE(Balance(Policy::printed).next(cut_equally(bodies, 4), work, {}) == cut_equally(bodies, 4));
  EXPECT_TRUE(balance.next(owners, std::vector<Work>(4, {{0}, {0}}), {}) == owners);
}

/// N (N + 1)/2 in four parts: the first bodies up to i have N^2/2 (1 - (1 - i/N)^2).
TEST(balance, as_printed_and_fixed_shares_out_the_most_contacts) {
  Balance balance(Policy::printed_fixed);
  const Owners owners = balance.first(cut_equally(bodies, 4), {});
  EXPECT_NEAR(owners.size(0), bodies * (1 - std::sqrt(0.75)), 1);
  EXPECT_NEAR(owners.size(3), bodies * std::sqrt(0.25), 1);
  EXPECT_TRUE(balance.next(owners, work_of(owners), {}) == owners);
}

TEST(balance, a_right_prediction_needs_one_interval) {
  std::vector<Real> due(bodies, 1);
  std::fill_n(due.begin(), bodies / 10, 30);
  EXPECT_LT(imbalance_after(Policy::predicted, 1, due), 1.5);
}

TEST(balance, the_first_ranges_follow_the_schedule_where_it_is_looked_at) {
  const Owners equal = cut_equally(bodies, 4);
  std::vector<Real> due(bodies, 1);
  std::fill_n(due.begin(), bodies / 10, 30);
  EXPECT_TRUE(Balance(Policy::measured).first(equal, {}) == equal);
  const Owners first = Balance(Policy::predicted).first(equal, outlook_of(due));
  EXPECT_LT(cost_of(first, 0), 1.2 * cost_of(first, 3));
}

TEST(balance, a_wrong_prediction_is_corrected_by_what_ranks_took) {
  const std::vector<Real> due(bodies, 1);
  EXPECT_GT(imbalance_after(Policy::predicted, 1, due), 10);
  EXPECT_LT(imbalance_after(Policy::predicted, 15, due), 2);
}

TEST(balance, noise_of_the_clock_moves_no_cut) {
  for (const Policy policy : {Policy::measured, Policy::predicted}) {
    Balance balance(policy);
    const Owners equal = cut_equally(bodies, 4);
    const std::vector<Real> due(bodies, 1);
    for (const Real noise : {0.01, -0.01, 0.005}) {
      auto work = std::vector<Work>(4, {{250e-6}, {250}});
      work[1].seconds[0] *= 1 + noise;
      EXPECT_TRUE(balance.next(equal, work, outlook_of(due)) == equal);
    }
  }
}

TEST(balance, an_interval_without_work_changes_nothing_that_harms) {
  Balance balance(Policy::predicted);
  const Owners equal = cut_equally(bodies, 4);
  const Owners next = balance.next(equal, std::vector<Work>(4, {{0}, {0}}), outlook_of(std::vector<Real>(bodies, 0)));
  for (int rank = 0; rank < 4; ++rank) EXPECT_GT(next.size(rank), 0);
}

}  // namespace
}  // namespace sazare::distribute
