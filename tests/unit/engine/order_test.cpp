/// The step is of second order, with one level and with levels mixed: half the step, a quarter of the error.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/networks.hpp"

namespace sazare::engine {
namespace {

constexpr Real end = 1.28;

/// Stability fraction and base step fall together, so that the levels stay as they are.
StepRules rules(bool mixed, int base_steps) {
  StepRules made;
  made.base_step = end / base_steps;
  made.stability = mixed;
  made.stability_fraction = 0.1 * 32 / base_steps;
  return made;
}

template <int D>
Snapshot<D> state_at_end(bool mixed, int base_steps) {
  auto simulation = test::ladder<D>().simulation(rules(mixed, base_steps));
  simulation.start();
  test::run(simulation, base_steps);
  EXPECT_EQ(test::level_range(simulation), mixed ? std::pair(0, 3) : std::pair(0, 0));
  return simulation.snapshot();
}

/// Distance in places, turns and velocities.
template <int D>
Real distance(const Snapshot<D>& a, const Snapshot<D>& b) {
  Real sum = 0;
  for (std::size_t body = 0; body < a.pose.size(); ++body)
    sum += (a.pose[body].position - b.pose[body].position).squaredNorm() +
           (a.pose[body].rotation - b.pose[body].rotation).squaredNorm() +
           (a.velocity[body] - b.velocity[body]).squaredNorm() +
           (a.angular_momentum[body] - b.angular_momentum[body]).squaredNorm();
  return std::sqrt(sum);
}

/// Order seen between two steps, against one 16 times smaller: that leaves (1/16)^2 of the error, 0.01 of the order; the
/// next terms of the error, of third order where levels are mixed, leave up to a tenth more.
template <int D>
Real observed_order(bool mixed) {
  const auto exact = state_at_end<D>(false, 16384);
  const Real coarse = distance(state_at_end<D>(mixed, 512), exact), fine = distance(state_at_end<D>(mixed, 1024), exact);
  return std::log2(coarse / fine);
}

TEST(order, is_two_with_one_level_in_the_plane) { EXPECT_NEAR(observed_order<2>(false), 2, 0.12); }
TEST(order, is_two_with_one_level_in_space) { EXPECT_NEAR(observed_order<3>(false), 2, 0.12); }
TEST(order, is_two_with_mixed_levels_in_the_plane) { EXPECT_NEAR(observed_order<2>(true), 2, 0.12); }
TEST(order, is_two_with_mixed_levels_in_space) { EXPECT_NEAR(observed_order<3>(true), 2, 0.12); }

TEST(order, mixed_levels_are_as_accurate_as_their_coarsest) {
  // Fine levels where they are needed cannot be worse than the base step everywhere.
  const auto exact = state_at_end<3>(false, 8192);
  EXPECT_LT(distance(state_at_end<3>(true, 256), exact), 1.2 * distance(state_at_end<3>(false, 256), exact));
}

}  // namespace
}  // namespace sazare::engine
