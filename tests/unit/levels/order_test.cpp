/// The step is of second order, with one level and with levels mixed: half the step, a quarter of the error.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/networks.hpp"

namespace sazare::levels {
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
Snapshot<D> state_at_end(bool mixed, int base_steps, Real damping) {
  auto network = test::ladder<D>();
  for (auto& spring : network.springs) spring.damping = damping * spring.stiffness;
  auto simulation = network.simulation(rules(mixed, base_steps));
  simulation.start();
  test::run(simulation, base_steps);
  EXPECT_EQ(test::level_range(simulation), mixed ? std::pair(0, 3) : std::pair(0, 0));
  return simulation.snapshot();
}

/// Order seen between two steps, against one 128 times smaller than the finer of them. With mixed levels the error is that
/// of the finest one, eight times smaller: (8/128)^2 of the error is left, 0.01 of the order.
template <int D>
Real observed_order(bool mixed, Real damping = 0, int base_steps = 256) {
  const auto exact = state_at_end<D>(false, 256 * base_steps, damping);
  const Real coarse = test::distance(state_at_end<D>(mixed, base_steps, damping), exact),
             fine = test::distance(state_at_end<D>(mixed, 2 * base_steps, damping), exact);
  return std::log2(coarse / fine);
}

TEST(order, is_two_with_one_level_in_the_plane) { EXPECT_NEAR(observed_order<2>(false), 2, 0.12); }
TEST(order, is_two_with_one_level_in_space) { EXPECT_NEAR(observed_order<3>(false), 2, 0.12); }
TEST(order, is_two_with_mixed_levels_in_the_plane) { EXPECT_NEAR(observed_order<2>(true), 2, 0.12); }
TEST(order, is_two_with_mixed_levels_in_space) { EXPECT_NEAR(observed_order<3>(true), 2, 0.12); }

/// With 256 steps the stiffest dashpots are still near their limit, and terms of higher order show.
TEST(order, is_two_with_dashpots_and_one_level) { EXPECT_NEAR(observed_order<3>(false, 0.01, 1024), 2, 0.05); }
TEST(order, is_two_with_dashpots_and_mixed_levels) { EXPECT_NEAR(observed_order<3>(true, 0.01), 2, 0.12); }

TEST(order, mixed_levels_are_as_accurate_as_their_coarsest) {
  // Fine levels where they are needed cannot be worse than the base step everywhere.
  const auto exact = state_at_end<3>(false, 8192, 0);
  EXPECT_LT(test::distance(state_at_end<3>(true, 256, 0), exact), 1.2 * test::distance(state_at_end<3>(false, 256, 0), exact));
}

}  // namespace
}  // namespace sazare::levels
