/// Levels follow from the rules: what a body's own springs ask for, and what its neighbours' levels do.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/networks.hpp"

namespace sazare::levels {
namespace {

/// A chain of masses along x whose springs get stiffer towards its end, each by the factor.
test::Network<2> chain(int masses, Real factor) {
  test::Network<2> made;
  for (int i = 0; i < masses; ++i) state::add_body(made.bodies, 1.0, Vector<2>(i, 0), 1.0, 0.0);
  Real stiffness = 1;
  for (Index i = 0; i + 1 < masses; ++i) {
    made.springs.push_back({i, i + 1, Vector<2>::Zero(), Vector<2>::Zero(), 1.0, stiffness, 0, 0});
    stiffness *= factor;
  }
  return made;
}

template <int D>
int largest_difference(const Simulation<D>& simulation, const test::Network<D>& network) {
  int largest = 0;
  for (const auto& spring : network.springs)
    if (spring.second != Link::outside)
      largest = std::max(largest, std::abs(simulation.levels().level(spring.first) - simulation.levels().level(spring.second)));
  return largest;
}

TEST(levels, a_body_gets_the_coarsest_step_within_its_own_limit) {
  const auto network = chain(5, 4);  // rates 1, 5, 20, 80, 64: steps 2 / sqrt(rate) x 0.5
  auto simulation = network.simulation({.base_step = 1.0, .stability_fraction = 0.5});
  simulation.start();
  const std::array<int, 5> expected = {0, 2, 3, 4, 3};
  for (Index body = 0; body < 5; ++body)
    EXPECT_EQ(simulation.levels().level(body), expected[static_cast<std::size_t>(body)]) << body;
  EXPECT_EQ(simulation.levels().finest(), 4);
  EXPECT_EQ(simulation.levels().step(4), 1.0 / 16);
  EXPECT_EQ(simulation.take_smallest_step(), 1.0 / 16);
}

TEST(levels, linked_bodies_differ_by_two_at_most) {
  const auto network = chain(6, 4096);  // on its own, each body would be six levels below its neighbour
  for (const int allowed : {0, 1, 2, 20}) {
    auto simulation = network.simulation({.base_step = 1.0, .neighbor_levels = allowed});
    simulation.start();
    const int largest = largest_difference(simulation, network);
    EXPECT_LE(largest, allowed);
    EXPECT_GE(largest, std::min(allowed, 3));
  }
}

TEST(levels, none_is_coarser_than_its_own_limit_because_of_its_neighbours) {
  const auto network = chain(6, 4096);
  auto limited = network.simulation({.base_step = 1.0, .neighbor_levels = 2});
  auto alone = network.simulation({.base_step = 1.0, .neighbor_levels = 24});
  limited.start();
  alone.start();
  for (Index body = 0; body < 6; ++body) EXPECT_GE(limited.levels().level(body), alone.levels().level(body));
}

TEST(levels, uniform_all_have_the_finest_that_any_asks_for) {
  auto simulation = chain(5, 4).simulation({.base_step = 1.0, .uniform = true, .stability_fraction = 0.5});
  simulation.start();
  EXPECT_EQ(test::level_range(simulation), std::pair(4, 4));
}

TEST(levels, without_limiter_all_keep_the_base_step) {
  auto simulation = chain(5, 4).simulation({.base_step = 1e-3, .stability = false});
  simulation.start();
  EXPECT_EQ(test::level_range(simulation), std::pair(0, 0));
}

TEST(levels, by_travel_follow_the_speed_up_and_down) {
  // One mass on a spring of the world: x = cos(t). The step is coarsest where it turns, finest in the middle.
  test::Network<2> network;
  state::add_body(network.bodies, 1.0, Vector<2>(1, 0), 1.0, 0.0);
  network.springs.push_back({0, Link::outside, Vector<2>::Zero(), Vector<2>(-10, 0), 10.0, 1.0, 0, 0});
  StepRules rules{.base_step = 0.05, .stability = false, .travel_length = 0.01};
  Real longest = 0;
  int turning = schedule::deepest_level, middle = 0;
  auto simulation = test::watched(network, rules, [&](const Instant& now, const state::Bodies<2>& bodies) {
    const auto& motion = bodies.motion[0];
    if (motion.last_kick == now.tick)
      longest = std::max(longest, motion.velocity.norm() * static_cast<Real>(motion.due - motion.last_kick) * now.tick_seconds);
  });
  simulation.start();
  for (int step = 1; step < 200; ++step) {
    simulation.advance();
    const Real phase = std::abs(std::cos(simulation.now().seconds()));
    const int level = simulation.levels().level(0);
    if (phase > 0.999) turning = std::min(turning, level);
    if (phase < 0.02) middle = std::max(middle, level);
  }
  EXPECT_LE(longest, 0.01 * (1 + 1e-12)) << "no step travels farther";
  EXPECT_GT(longest, 0.005) << "nor is it shorter than it must be";
  EXPECT_EQ(turning, 0);
  EXPECT_EQ(middle, 3);  // speed 1: 0.05 / 8 < 0.01
}

TEST(levels, what_is_due_is_all_that_is_computed) {
  const auto network = chain(5, 4);
  auto simulation = network.simulation({.base_step = 1.0, .stability_fraction = 0.5});  // levels 0 2 3 4 3
  simulation.start();
  const auto before = simulation.counters();
  simulation.advance();
  const auto after = simulation.counters();
  EXPECT_EQ(after.kicks - before.kicks, 4 + 8 + 16 + 16 + 16) << "every body at the level of its finest link";
  EXPECT_EQ(after.pair_evaluations - before.pair_evaluations, 4 + 8 + 16 + 16);
  EXPECT_EQ(after.ticks - before.ticks, 16);
  EXPECT_EQ(after.uniform_evaluations - before.uniform_evaluations, 4 * 16);
}

}  // namespace
}  // namespace sazare::levels
