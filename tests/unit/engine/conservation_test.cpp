/// Action equals reaction at any mix of levels: a free body keeps its momenta to round-off.

#include <gtest/gtest.h>

#include "tests/support/networks.hpp"

namespace sazare::engine {
namespace {

StepRules stability() {
  StepRules rules;
  rules.base_step = 0.08;
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
  const Real before = test::mechanical(simulation.ledger());
  Real kinetic = 0;
  for (std::size_t body = 0; body < 6; ++body)
    kinetic += 0.5 * simulation.bodies().inertia[body].mass * simulation.bodies().motion[body].velocity.squaredNorm();
  simulation.start();
  Real largest = 0;
  while (simulation.now().seconds() < 16) {
    simulation.advance();
    largest = std::max(largest, std::abs(test::mechanical(simulation.ledger()) - before) / kinetic);
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
  // Waiting impulses make the undamped step drift by a growth of third order: half the step, an eighth of it.
  const StepRules coarse{.base_step = 0.02, .stability_fraction = 0.0625}, fine{.base_step = 0.01, .stability_fraction = 0.03125};
  EXPECT_LT(energy_error(coarse), 0.1);
  EXPECT_LT(energy_error(fine), 0.35 * energy_error(coarse));
}

}  // namespace
}  // namespace sazare::engine
