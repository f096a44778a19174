/// Energy that comes in is found again: stored, moving, or taken by a named cause.

#include <gtest/gtest.h>

#include <cmath>

#include "sazare/levels/terms/gravity.hpp"
#include "tests/support/networks.hpp"

namespace sazare::levels {
namespace {

using terms::EnergyKind;

test::Network<3> damped(Real damping) {
  auto network = test::ladder<3>();
  for (auto& spring : network.springs) spring.damping = damping;
  return network;
}

/// EnergyBalance after 2.56 s.
terms::EnergyBalance balance_at_end(const test::Network<3>& network, int base_steps) {
  StepRules rules;
  rules.base_step = 2.56 / base_steps;
  rules.stability_fraction = 0.25 * 32 / base_steps;
  auto simulation = network.simulation(rules);
  simulation.start();
  test::run(simulation, base_steps);
  EXPECT_GE(test::level_range(simulation).second - test::level_range(simulation).first, 2);
  return simulation.energy_balance();
}

TEST(energy_balance, closes_with_dashpots_at_mixed_levels) {
  // What the dashpots take is added up exactly; the leapfrog's own error of energy is left, (w h)^2 / 8 of what swings.
  for (const int base_steps : {128, 256}) {
    const auto balance = balance_at_end(damped(0.1), base_steps);
    EXPECT_GT(balance[EnergyKind::joint_dashpot], 0.05);
    EXPECT_LT(balance[EnergyKind::elastic], 0);  // the springs are stretched at the beginning, and give that away
    EXPECT_LT(std::abs(balance.residual()), 1e-3 * balance[EnergyKind::joint_dashpot]) << base_steps;
  }
}

TEST(energy_balance, dashpots_only_take) {
  auto simulation = damped(0.2).simulation({.base_step = 0.02});
  simulation.start();
  Real last = 0;
  for (int step = 0; step < 100; ++step) {
    simulation.advance();
    const Real taken = simulation.energy_balance()[EnergyKind::joint_dashpot];
    EXPECT_GE(taken, last);
    last = taken;
  }
}

TEST(energy_balance, gravity_gives_what_the_bodies_gain) {
  auto network = test::ladder<3>();
  TermList<3> terms;
  terms.push_back(std::make_unique<terms::Springs<3>>(network.springs, network.bodies));
  terms.push_back(std::make_unique<terms::Gravity<3>>(Vector3(0, 0, -10), network.bodies));
  Simulation<3> simulation(network.bodies, std::move(terms), {.base_step = 0.01});
  simulation.start();
  test::run(simulation, 100);
  const auto balance = simulation.energy_balance();
  EXPECT_GT(balance[EnergyKind::work], 100);  // 4.5 kg fall 5 m
  EXPECT_LT(std::abs(balance.residual()), 2e-5 * balance[EnergyKind::work]);
}

TEST(energy_balance, at_the_beginning_all_is_nothing) {
  auto simulation = damped(0.1).simulation({.base_step = 0.01});
  const auto balance = simulation.energy_balance();
  EXPECT_EQ(balance[EnergyKind::kinetic], 0);
  EXPECT_EQ(balance[EnergyKind::joint_dashpot], 0);
  EXPECT_EQ(balance[EnergyKind::elastic], 0);
  EXPECT_EQ(balance.residual(), 0);
}

}  // namespace
}  // namespace sazare::levels
