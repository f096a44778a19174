/// Action equals reaction at any mix of levels: a free body keeps its momenta to round-off.

#include <gtest/gtest.h>

#include "tests/support/networks.hpp"

namespace sazare::levels {
namespace {

StepRules stability() {
  StepRules rules;
  rules.base_step = 0.08;
  rules.stability_fraction = 0.25;
  return rules;
}

StepRules travel() {
  StepRules rules;
  rules.base_step = 0.04;
  rules.stability = false;
  rules.travel_length = 0.01;
  return rules;
}

/// Runs a free network and compares the momenta with those at the beginning. The impulses that bodies have given each
/// other are of the size mass x speed x number of oscillations; 1e-12 of the total mass x speed is some 1e4 roundings.
template <int D>
void expect_conserved(const StepRules& rules, int base_steps, bool damped, int least_difference) {
  auto network = test::ladder<D>();
  if (damped)
    for (auto& spring : network.springs) spring.damping = 0.05;
  auto simulation = network.simulation(rules);
  const auto before = test::momentum(simulation);
  Real scale = 0;
  for (std::size_t body = 0; body < network.bodies.motion.size(); ++body)
    scale += network.bodies.inertia[body].mass * network.bodies.motion[body].velocity.norm();
  simulation.start();
  int difference = 0;
  for (int step = 0; step < base_steps; ++step) {
    simulation.advance();
    const auto [lowest, highest] = test::level_range(simulation);
    difference = std::max(difference, highest - lowest);
    const auto now = test::momentum(simulation);
    ASSERT_LT((now.linear - before.linear).norm(), 1e-12 * scale) << step;
    ASSERT_LT((now.angular - before.angular).norm(), 1e-12 * scale) << step;
  }
  EXPECT_GE(difference, least_difference) << "the test needs mixed levels";
}

TEST(conservation, of_momenta_with_one_level) {
  StepRules rules = stability();
  rules.stability = false;
  rules.base_step = 0.02;
  expect_conserved<2>(rules, 300, false, 0);
  expect_conserved<3>(rules, 300, false, 0);
}

TEST(conservation, of_momenta_with_mixed_levels) {
  expect_conserved<2>(stability(), 300, false, 2);
  expect_conserved<3>(stability(), 300, false, 2);
}

TEST(conservation, of_momenta_with_mixed_levels_and_dashpots) {
  expect_conserved<2>(stability(), 300, true, 2);
  expect_conserved<3>(stability(), 300, true, 2);
}

TEST(conservation, of_momenta_while_levels_change_and_bodies_wake) {
  expect_conserved<2>(travel(), 300, false, 1);
  expect_conserved<3>(travel(), 300, false, 1);
}

/// Largest error of the energy in 16 s, some seventy periods of the fastest pair, relative to the kinetic energy at the
/// beginning.
Real energy_error(const StepRules& rules) {
  auto simulation = test::ladder<3>().simulation(rules);
  const Real before = test::mechanical(simulation.energy_balance());
  Real kinetic = 0;
  for (std::size_t body = 0; body < 6; ++body)
    kinetic += 0.5 * simulation.bodies().inertia[body].mass * simulation.bodies().motion[body].velocity.squaredNorm();
  simulation.start();
  Real largest = 0;
  while (simulation.now().seconds() < 16) {
    simulation.advance();
    largest = std::max(largest, std::abs(test::mechanical(simulation.energy_balance()) - before) / kinetic);
  }
  return largest;
}

TEST(conservation, of_energy_with_one_level) {
  // The leapfrog swings by (w h)^2 / 8 of the energy of the fastest pair, w = 27 1/s, and does not drift.
  const Real coarse = energy_error({.base_step = 0.005, .stability = false});
  const Real fine = energy_error({.base_step = 0.0025, .stability = false});
  EXPECT_LT(coarse, 0.01);
  EXPECT_LT(fine, 0.4 * coarse);
}

TEST(conservation, of_energy_with_mixed_levels) {
  const StepRules coarse{.base_step = 0.04, .stability_fraction = 0.125}, fine{.base_step = 0.02, .stability_fraction = 0.0625};
  EXPECT_LT(energy_error(coarse), 0.01);
  EXPECT_LT(energy_error(fine), 0.4 * energy_error(coarse));
}

/// Largest error of the energy of a heavy mass at level 0 between a wall and a light one at level 2, without dashpots, over
/// periods of the heavy one.
Real energy_error_of_pair(int periods) {
  test::Network<2> network;
  state::add_body(network.bodies, 1.0, Vector<2>(1, 0), 1.0, 0.0);
  state::add_body(network.bodies, 1.0 / 16, Vector<2>(2, 0), 1.0, 0.0);
  network.bodies.motion[0].velocity.x() = 0.1;
  const Vector<2> none = Vector<2>::Zero();
  network.springs = {{0, Link::outside, none, none, 1, 1, 0, 0}, {0, 1, none, none, 1, 1, 0, 0}};
  auto simulation = network.simulation({.base_step = 0.35, .stability_fraction = 0.25});
  simulation.start();
  EXPECT_EQ(simulation.levels().level(1) - simulation.levels().level(0), 2);
  Real largest = 0;
  while (simulation.now().seconds() < periods * 2 * M_PI) {
    simulation.advance();
    largest = std::max(largest, std::abs(test::mechanical(simulation.energy_balance())) / 0.005);
  }
  return largest;
}

TEST(conservation, the_energy_of_undamped_mixed_levels_does_not_grow) {
  // Were impulses kept waiting for the heavy mass, its energy would grow 12000-fold in 45 periods.
  EXPECT_LT(energy_error_of_pair(1000), 1.2 * energy_error_of_pair(50));
  EXPECT_LT(energy_error_of_pair(1000), 0.05);
}

}  // namespace
}  // namespace sazare::levels
