#include <gtest/gtest.h>

#include <algorithm>

#include "sazare/levels/simulation.hpp"
#include "tests/support/networks.hpp"

namespace sazare::levels {
namespace {

TEST(simulation, time_is_counted_in_whole_base_steps) {
  auto simulation = test::ladder<3>().simulation({.base_step = 0.08});
  simulation.start();
  EXPECT_EQ(simulation.now().seconds(), 0);
  test::run(simulation, 25);
  EXPECT_EQ(simulation.now().tick, 25 * schedule::base_stride);
  EXPECT_DOUBLE_EQ(simulation.now().seconds(), 2.0);
  for (const auto& motion : simulation.bodies().motion) EXPECT_EQ(motion.last_kick, simulation.now().tick);
}

template <int D>
void expect_same_motion_about(const Vector<D>& pole, Real damping, Real within) {
  auto about_zero = test::ladder<D>(), about_pole = test::ladder<D>();
  for (auto* network : {&about_zero, &about_pole})
    for (auto& spring : network->springs) spring.damping = damping;
  about_pole.bodies.pole = pole;
  auto one = about_zero.simulation({.base_step = 0.08}), other = about_pole.simulation({.base_step = 0.08});
  for (auto* simulation : {&one, &other}) {
    simulation->start();
    test::run(*simulation, 50);
  }
  ASSERT_GT(one.levels().finest(), 0);
  for (std::size_t body = 0; body < about_zero.bodies.motion.size(); ++body) {
    const auto &mine = one.bodies().motion[body], &theirs = other.bodies().motion[body];
    EXPECT_LT((mine.position - theirs.position).norm(), within);
    EXPECT_LT((mine.angular_momentum - theirs.angular_momentum).norm(), within);
  }
  const auto first = one.energy_balance(), second = other.energy_balance();
  for (const auto account : {terms::EnergyKind::kinetic, terms::EnergyKind::joint_dashpot})
    EXPECT_NEAR(first[account], second[account], 1e-7 * std::abs(first[account]));
}

TEST(simulation, where_the_pole_lies_changes_nothing) {
  expect_same_motion_about<2>(Vector<2>(3, -2), 0, 1e-12);
  expect_same_motion_about<3>(Vector<3>(3, -2, 1), 0, 1e-12);
}

TEST(simulation, where_the_pole_lies_changes_velocities_predicted_by_single_precision_at_most) {
  expect_same_motion_about<2>(Vector<2>(3, -2), 0.1, 1e-9);
  expect_same_motion_about<3>(Vector<3>(3, -2, 1), 0.1, 1e-9);
}

TEST(simulation, says_where_its_time_went) {
  auto simulation = test::ladder<3>().simulation({.base_step = 0.08});
  simulation.start();
  test::run(simulation, 10);
  std::vector<std::string> parts;
  Real sum = 0;
  for (const auto& part : simulation.part_times()) {
    parts.push_back(part.part);
    sum += part.seconds;
    EXPECT_GE(part.seconds, 0);
  }
  EXPECT_EQ(parts, (std::vector<std::string>{"springs", "bodies", "schedule"}));
  EXPECT_GT(sum, 0);
}

TEST(simulation, the_smallest_step_is_that_since_it_was_asked_for) {
  // A body that slows down: levels become coarser, and the finest is forgotten once it was told.
  test::Network<2> network;
  state::add_body(network.bodies, 1.0, Vector<2>(0, 0), 1.0, 0.0);
  network.bodies.motion[0].velocity.x() = 1;
  network.springs.push_back({0, Link::outside, Vector<2>::Zero(), Vector<2>(-10, 0), 10.0, 1.0, 0, 0});
  auto simulation = network.simulation({.base_step = 0.05, .stability = false, .travel_length = 0.01});
  simulation.start();
  const Real fast = simulation.take_smallest_step();
  EXPECT_DOUBLE_EQ(fast, 0.05 / 8);
  while (simulation.bodies().motion[0].velocity.x() > 0.3) simulation.advance();
  simulation.take_smallest_step();
  simulation.advance();
  EXPECT_GT(simulation.take_smallest_step(), fast);
}

TEST(simulation, an_unlinked_body_flies_straight_on_at_the_base_step) {
  test::Network<3> network;
  test::add_body_at(network.bodies, 1.0, 0, 0);
  network.bodies.motion[0].velocity = {1, 2, 3};
  auto simulation = network.simulation({.base_step = 0.5});
  simulation.start();
  test::run(simulation, 4);
  EXPECT_EQ(simulation.snapshot().pose[0].position, Vector3(2, 4, 6));
  EXPECT_EQ(simulation.levels().level(0), 0);
  EXPECT_EQ(simulation.counters().kicks, 5);
}

}  // namespace
}  // namespace sazare::levels
