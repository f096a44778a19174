/// A body hit hard at a coarse level moves at once, whatever tick it is, and takes the level that its speed asks for.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/networks.hpp"

namespace sazare::levels {
namespace {

/// A fast body runs into a row of three at rest, joined to each other. Only its own speed asks for a level at first.
test::Network<2> collision() {
  test::Network<2> made;
  for (int i = 0; i < 4; ++i) state::add_body(made.bodies, 1.0, Vector<2>(i == 0 ? -0.0085 : i, 0), 1.0, 0.0);
  made.bodies.motion[0].velocity.x() = 1;
  for (Index i = 0; i < 3; ++i) made.springs.push_back({i, i + 1, Vector<2>::Zero(), Vector<2>::Zero(), 1.0, 1e4, 0, i == 0});
  return made;
}

constexpr Real travel_length = 1e-4;

StepRules rules(int neighbor_levels) {
  return {.base_step = 0.004, .stability = false, .travel_length = travel_length, .neighbor_levels = neighbor_levels};
}

struct Seen {
  Tick first_kick = -1;  ///< that sets the struck body in motion
  Real longest = 0;      ///< travel in a step, of all bodies
  int difference = 0;    ///< of levels between neighbours, after settling
  Real last_position = 0;
};

Seen collide(const test::Network<2>& network, const StepRules& step_rules, Real seconds) {
  Seen seen;
  std::vector<Vector<2>> at_kick(network.bodies.motion.size(), Vector<2>::Zero());
  std::vector<Tick> kicked(network.bodies.motion.size(), -1);
  auto simulation = test::watched(network, step_rules, [&](const Instant& now, const state::Bodies<2>& bodies) {
    for (std::size_t body = 0; body < bodies.motion.size(); ++body) {
      const auto& motion = bodies.motion[body];
      if (motion.last_kick == kicked[body]) continue;
      const Vector<2> here = motion.position - now.seconds_since(now.tick - (motion.due - motion.last_kick)) * motion.velocity;
      if (kicked[body] >= 0) seen.longest = std::max(seen.longest, (here - at_kick[body]).norm());
      at_kick[body] = here;
      kicked[body] = motion.last_kick;
      if (body == 1 && seen.first_kick < 0 && motion.velocity.norm() > 0) seen.first_kick = motion.last_kick;
    }
  });
  simulation.start();
  while (simulation.now().seconds() < seconds) {
    simulation.advance();
    for (Index body = 0; body < 3; ++body)
      seen.difference =
          std::max(seen.difference, std::abs(simulation.levels().level(body) - simulation.levels().level(body + 1)));
  }
  seen.last_position = simulation.snapshot().pose[3].position.x();
  return seen;
}

TEST(wake, a_struck_body_does_not_sleep_until_its_own_time) {
  const Seen seen = collide(collision(), rules(20), 0.04);
  ASSERT_GT(seen.first_kick, 0);
  EXPECT_NE(seen.first_kick % schedule::base_stride, 0) << "between base steps";
  // The ball meets the row at 8.5 ms, with steps of 4 ms / 2^6.
  const Real woken = static_cast<Real>(seen.first_kick) * 0.004 / static_cast<Real>(schedule::base_stride);
  EXPECT_GE(woken, 0.0085);
  EXPECT_LT(woken, 0.0085 + 2 * 0.004 / 64);
}

TEST(wake, no_body_travels_farther_than_the_rule_allows) {
  EXPECT_LT(collide(collision(), rules(20), 0.04).longest, (1 + 1e-9) * travel_length);
  EXPECT_LT(collide(collision(), rules(2), 0.04).longest, (1 + 1e-9) * travel_length);
}

TEST(wake, neighbours_are_woken_with_the_body) {
  EXPECT_LE(collide(collision(), rules(2), 0.04).difference, 2);
  EXPECT_GT(collide(collision(), rules(20), 0.04).difference, 2) << "the limiter must have had something to do";
}

TEST(wake, the_motion_is_that_of_uniform_levels) {
  StepRules uniform = rules(2);
  uniform.uniform = true;
  const Real expected = collide(collision(), uniform, 0.04).last_position;
  const Real moved = expected - 3;
  EXPECT_GT(moved, 1e-3);
  // The row's own springs are stepped by the base step where no one is fast: (w h)^2 / 24 with w = 200 1/s.
  EXPECT_NEAR(collide(collision(), rules(2), 0.04).last_position, expected, 0.03 * moved);
  EXPECT_NEAR(collide(collision(), rules(20), 0.04).last_position, expected, 0.03 * moved);
}

TEST(wake, of_one_wakes_all_where_levels_are_uniform) {
  StepRules uniform = rules(2);
  uniform.uniform = true;
  auto simulation = collision().simulation(uniform);
  simulation.start();
  for (int step = 0; step < 10; ++step) {
    simulation.advance();
    const auto [lowest, highest] = test::level_range(simulation);
    EXPECT_EQ(lowest, highest);
  }
}

TEST(wake, energy_is_kept_through_it) {
  auto simulation = collision().simulation(rules(2));
  simulation.start();
  for (int step = 0; step < 10; ++step) {
    simulation.advance();
    // The leapfrog's own error: (w h)^2 / 8 of the energy with w = 200 1/s and the step of the fastest, 1e-4 s.
    EXPECT_NEAR(test::mechanical(simulation.energy_balance()), 0, 1e-4 * 0.5) << step;
  }
}

}  // namespace
}  // namespace sazare::levels
