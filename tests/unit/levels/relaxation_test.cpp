/// Bodies that come to equilibrium before time begins.

#include <gtest/gtest.h>

#include "tests/support/networks.hpp"

namespace sazare::levels {
namespace {

/// Relaxes until a share of the force that is given for each body is left, and goes on to where time could begin.
template <int D>
void relax(Simulation<D>& simulation, Real force, Real share) {
  const std::vector<Real> meaningful(simulation.bodies().motion.size(), force);
  simulation.relax();
  simulation.stand();
  simulation.start();
  Real left = simulation.largest_unbalance(meaningful).share, before = 0;
  EXPECT_GT(left, 1e3 * share);
  for (int step = 0; step < 20000 && left > share; ++step) {
    simulation.approach();
    const Real kinetic = simulation.kinetic_energy();
    const bool is_past_peak = kinetic < before;
    if (is_past_peak) simulation.stand();
    before = is_past_peak ? 0 : kinetic;
    simulation.arrive();
    if (is_past_peak) left = simulation.largest_unbalance(meaningful).share;
  }
  EXPECT_LE(left, share);
  EXPECT_FALSE(simulation.now().has_begun());
  EXPECT_LT(simulation.now().seconds(), 0);
  EXPECT_EQ(simulation.levels().finest(), 0);
  simulation.approach();
}

/// The bodies of a relaxed ladder, with given velocities.
template <int D>
void expect_the_run_of_one_that_begins_there() {
  auto network = test::ladder<D>();
  auto simulation = network.simulation({.base_step = 0.08});
  relax(simulation, 4 * 0.03, 1e-9);
  for (std::size_t body = 0; body < network.bodies.motion.size(); ++body) {
    EXPECT_EQ(simulation.bodies().inertia[body].mass, network.bodies.inertia[body].mass);
    EXPECT_EQ(simulation.bodies().inertia[body].inverse_moments, network.bodies.inertia[body].inverse_moments);
  }
  std::vector<Vector<D>> velocity;
  for (const auto& motion : network.bodies.motion) velocity.push_back(motion.velocity);
  simulation.stand(velocity);
  network.bodies = simulation.bodies();
  for (auto& motion : network.bodies.motion) {
    motion.last_kick = -1;
    motion.due = 0;
  }
  auto fresh = network.simulation({.base_step = 0.08});
  fresh.start();
  simulation.begin_time({});
  for (const Real joules : simulation.energy_balance().joules) EXPECT_LT(std::abs(joules), 1e-14);
  for (int step = 0; step < 50; ++step) {
    EXPECT_EQ(simulation.now().seconds(), fresh.now().seconds());
    for (std::size_t body = 0; body < velocity.size(); ++body) {
      const auto &one = simulation.bodies().motion[body], &other = fresh.bodies().motion[body];
      EXPECT_EQ(one.position, other.position);
      EXPECT_EQ(one.velocity, other.velocity);
      EXPECT_EQ(one.angular_momentum, other.angular_momentum);
    }
    simulation.advance();
    fresh.advance();
  }
  EXPECT_GT(simulation.levels().finest(), 0);
  EXPECT_EQ(simulation.counters().pair_evaluations, fresh.counters().pair_evaluations);
  EXPECT_NEAR(simulation.energy_balance()[terms::EnergyKind::elastic], fresh.energy_balance()[terms::EnergyKind::elastic], 1e-14);
}

TEST(relaxation, a_run_goes_on_from_the_equilibrium_with_the_bits_of_one_that_begins_there) {
  expect_the_run_of_one_that_begins_there<2>();
  expect_the_run_of_one_that_begins_there<3>();
}

TEST(relaxation, the_equilibrium_of_a_ladder_is_that_of_its_springs) {
  auto simulation = test::ladder<3>().simulation({.base_step = 0.08});
  relax(simulation, 4 * 0.03, 1e-9);
  simulation.stand();
  simulation.begin_time({});
  test::run(simulation, 50);
  for (const auto& motion : simulation.bodies().motion) EXPECT_LT(motion.velocity.norm(), 1e-3);
  EXPECT_LT(simulation.energy_balance()[terms::EnergyKind::kinetic], 1e-6);
}

TEST(relaxation, the_largest_unbalance_is_that_of_force_and_moment) {
  test::Network<2> network;
  for (const Real x : {0.0, 2.0}) state::add_body(network.bodies, 1.0, Vector<2>(x, 0), 1.0, 0.5);
  // A spring along y at the end of an arm of 0.25: the force is 3 x 0.1, the moment a quarter of it, over a reach of 0.5.
  network.springs.push_back({1, Link::outside, Vector<2>(0.25, 0), Vector<2>(2.25, 1.1), 1.0, 3.0, 0, 0});
  auto simulation = network.simulation({.base_step = 0.01});
  simulation.start();
  const Unbalance largest = simulation.largest_unbalance(std::vector<Real>{1, 2});
  EXPECT_EQ(largest.body, 1);
  EXPECT_NEAR(largest.share, (0.3 + 0.25 * 0.3 / 0.5) / 2, 1e-9);
}

}  // namespace
}  // namespace sazare::levels
