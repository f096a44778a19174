/// Forces from outside act as if they had been known at the kick that they come after.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "sazare/levels/terms/outside_forces.hpp"
#include "tests/support/memory_archive.hpp"
#include "tests/support/networks.hpp"

namespace sazare::levels {
namespace {

using terms::EnergyKind;
using Loads = std::vector<terms::OutsideForces::Load>;

/// A network with forces from outside.
struct Pushed {
  terms::OutsideForces* forces = nullptr;
  std::unique_ptr<Simulation<3>> simulation;

  Pushed(const test::Network<3>& network, const StepRules& rules) {
    TermList<3> list;
    list.push_back(std::make_unique<terms::Springs<3>>(network.springs, network.bodies));
    auto term = std::make_unique<terms::OutsideForces>(network.bodies);
    forces = term.get();
    list.push_back(std::move(term));
    simulation = std::make_unique<Simulation<3>>(network.bodies, std::move(list), rules);
  }

  void push(const Loads& loads) {
    std::vector<Index> which;
    std::vector<state::Impulse<3>> more;
    for (const auto& lacking : forces->set(loads, simulation->now(), simulation->bodies())) {
      which.push_back(lacking.body);
      more.push_back(lacking.impulse);
    }
    simulation->add_to_kicks(which, more);
  }
  void run(int steps, const std::function<Loads(const Simulation<3>&)>& loads) {
    for (int step = 0; step < steps; ++step) {
      push(loads(*simulation));
      simulation->advance();
    }
  }
};

/// Of all bodies at a base step, about the origin.
test::Momentum<3> momentum_now(const Simulation<3>& simulation) {
  const Snapshot<3> now = simulation.snapshot();
  test::Momentum<3> sum;
  for (std::size_t body = 0; body < now.pose.size(); ++body) {
    const Vector3 linear = simulation.bodies().inertia[body].mass * now.velocity[body];
    sum.linear += linear;
    sum.angular += now.angular_momentum[body] + now.pose[body].position.cross(linear);
  }
  return sum;
}

test::Network<3> alone(Real mass = 2) {
  test::Network<3> network;
  test::add_body_at(network.bodies, mass, 0.7, 0.2);
  network.bodies.pole = Vector3(0.1, -0.3, 0.2);
  return network;
}

Loads changing(const Simulation<3>& simulation) {
  Loads loads(static_cast<std::size_t>(simulation.bodies().size()));
  const Real t = simulation.now().seconds();
  for (std::size_t body = 0; body < loads.size(); ++body) {
    const Real n = static_cast<Real>(body);
    loads[body].force = Vector3(std::sin(3 * t + n), 0.5 * std::cos(5 * t), 0.2 * n);
    loads[body].moment = 0.05 * Vector3(std::cos(2 * t), std::sin(4 * t - n), 0.3);
  }
  return loads;
}

TEST(outside_forces, a_constant_force_and_moment_move_a_body_exactly) {
  Pushed one(alone(), {.base_step = 0.01});
  one.simulation->start();
  const Vector3 start = one.simulation->snapshot().pose[0].position;
  const Vector3 axis = one.simulation->snapshot().pose[0].rotation.col(2);
  one.run(200, [&](const Simulation<3>&) { return Loads{{Vector3(1, -2, 0.5), 0.3 * axis}}; });
  const Snapshot<3> now = one.simulation->snapshot();
  EXPECT_LT((now.velocity[0] - 2 * Vector3(1, -2, 0.5) / 2).norm(), 1e-13);
  EXPECT_LT((now.pose[0].position - start - 2 * Vector3(1, -2, 0.5) / 2).norm(), 1e-13);  // t^2/2 F/m: leapfrog is exact
  EXPECT_LT((now.angular_momentum[0] - 2 * 0.3 * axis).norm(), 1e-13);
  EXPECT_LT((now.pose[0].rotation.col(2) - axis).norm(), 1e-12);
}

TEST(outside_forces, momenta_gain_what_is_given_at_any_mix_of_levels) {
  auto network = test::ladder<3>();
  network.bodies.pole = Vector3(1, 0.5, 0.2);
  Pushed all(network, {.base_step = 0.08});
  all.simulation->start();
  const auto before = momentum_now(*all.simulation);
  Loads loads(6);
  for (std::size_t body = 0; body < 6; ++body) loads[body].moment = Vector3(0.01, -0.02, 0.01 * static_cast<Real>(body));
  all.run(30, [&](const Simulation<3>&) { return loads; });
  EXPECT_GE(test::level_range(*all.simulation).second, 2);
  const auto turned = momentum_now(*all.simulation);
  EXPECT_LT((turned.linear - before.linear).norm(), 1e-13);
  EXPECT_LT((turned.angular - before.angular - 2.4 * Vector3(0.06, -0.12, 0.15)).norm(), 1e-12);
  const Vector3 force(0.02, 0.01, -0.03);
  loads.assign(6, {force, Vector3::Zero()});
  Real acting = 6 * 2.4;  // and from the middle of the last step of each body on
  for (Index body = 0; body < 6; ++body) acting += 0.5 * all.simulation->levels().step(all.simulation->levels().level(body));
  all.run(30, [&](const Simulation<3>&) { return loads; });
  EXPECT_LT((momentum_now(*all.simulation).linear - before.linear - acting * force).norm(), 1e-12);
}

TEST(outside_forces, those_that_come_after_the_first_kick_are_as_those_known_before) {
  auto network = test::ladder<3>();
  Pushed before(network, {.base_step = 0.08}), after(network, {.base_step = 0.08});
  const Loads loads = changing(*before.simulation);
  before.push(loads);
  before.simulation->start();
  after.simulation->start();
  after.push(loads);
  EXPECT_LT(test::distance(after.simulation->snapshot(), before.simulation->snapshot()), 1e-14);
  test::run(*before.simulation, 20);
  test::run(*after.simulation, 20);
  EXPECT_LT(test::distance(after.simulation->snapshot(), before.simulation->snapshot()), 1e-11);
}

/// Largest share of the kinetic energy of a free body by which the work of its forces is another.
Real imbalance(const std::function<Loads(const Simulation<3>&)>& loads, Real step) {
  Pushed one(alone(), {.base_step = step});
  one.simulation->start();
  Real worst = 0;
  const auto look = [&] {
    const auto balance = one.simulation->energy_balance();
    worst = std::max(worst, std::abs(balance[EnergyKind::work] / balance[EnergyKind::kinetic] - 1));
  };
  for (Real t = 0; t < 2; t += step) {
    one.run(1, loads);
    look();
    one.push(loads(*one.simulation));  // the balance closes on either side of a change
    look();
  }
  return worst;
}

TEST(outside_forces, their_work_is_what_a_free_body_gains) {
  const auto forces_alone = [](const Simulation<3>& simulation) {
    Loads loads = changing(simulation);
    loads[0].moment.setZero();
    return loads;
  };
  EXPECT_LT(imbalance(forces_alone, 0.02), 1e-13);
  // A body that turns freely keeps its energy to the second order only.
  const Real coarse = imbalance(changing, 0.02), fine = imbalance(changing, 0.01);
  EXPECT_LT(coarse, 1e-8);
  EXPECT_LT(fine, coarse / 3.5);
}

TEST(outside_forces, their_work_balances_in_a_network_of_mixed_levels) {
  std::array<Real, 2> residual{};
  for (const int finer : {0, 1}) {
    Pushed all(test::ladder<3>(), {.base_step = finer ? 0.02 : 0.04, .stability_fraction = finer ? 0.125 : 0.25});
    all.simulation->start();
    all.run(finer ? 128 : 64, changing);
    EXPECT_GE(test::level_range(*all.simulation).second, 2);
    EXPECT_GT(all.simulation->energy_balance()[EnergyKind::work], 1);
    residual[static_cast<std::size_t>(finer)] = std::abs(all.simulation->energy_balance().residual());
  }
  EXPECT_LT(residual[0], 1e-2);
  EXPECT_LT(residual[1], residual[0] / 3);  // what the leapfrog step makes of energy is of second order
}

/// The swing on a spring of the caller's is that of the leapfrog step, whose amplitude stays for ever.
TEST(outside_forces, a_force_of_the_position_is_part_of_the_leapfrog_step) {
  const Real rate = 3, step = 0.1, mass = 2, half = std::asin(rate * step / 2);
  Pushed one(alone(mass), {.base_step = step});
  one.simulation->start();
  const Vector3 middle = one.simulation->snapshot().pose[0].position - Vector3(0.5, 0, 0);
  for (int n = 0; n < 1000; ++n) {
    const Vector3 away = one.simulation->snapshot().pose[0].position - middle;
    EXPECT_NEAR(away.x(), 0.5 * std::cos(2 * half * n), 2e-12) << n;
    one.run(1, [&](const Simulation<3>&) { return Loads{{-mass * rate * rate * away, Vector3::Zero()}}; });
  }
}

/// On a finer level it is held through the base step and lags, which feeds a swing.
TEST(outside_forces, a_force_of_the_position_that_is_held_feeds_a_swing_as_its_lag_does) {
  test::Network<3> network;
  for (const Real x : {0.0, 1.0}) test::add_body_at(network.bodies, 1, x, 0);
  network.springs.push_back({});
  terms::Spring<3>& spring = network.springs.back();
  spring.first = 0;
  spring.second = 1;
  spring.length = 1;
  spring.stiffness = 6400;
  Pushed pair(network, {.base_step = 0.1});
  pair.simulation->start();
  const int level = pair.simulation->levels().level(0);
  EXPECT_GE(level, 2);
  const Real lag = 0.5 * (0.1 - pair.simulation->levels().step(level)), away = 0.5, time = 20;
  const auto swing = [&](const Simulation<3>& simulation) {
    const auto now = simulation.snapshot();
    Loads loads(2);
    for (std::size_t body = 0; body < 2; ++body)
      loads[body].force = Vector3(static_cast<Real>(body) - away - now.pose[body].position.x(), 0, 0);  // at the rate 1/s
    return loads;
  };
  pair.run(200, swing);
  const auto now = pair.simulation->snapshot();
  const Real out = now.pose[0].position.x() + away, speed = now.velocity[0].x();
  EXPECT_NEAR(std::log((out * out + speed * speed) / (away * away)), lag * time, 0.05 * lag * time);
}

TEST(outside_forces, a_kick_that_makes_a_body_too_fast_refines_it_at_once) {
  const StepRules rules{.base_step = 0.1, .stability = false, .travel_length = 0.02};
  Pushed one(alone(1), rules);
  one.simulation->start();
  EXPECT_EQ(one.simulation->levels().level(0), 0);
  one.push({{Vector3(100, 0, 0), Vector3::Zero()}});
  EXPECT_EQ(one.simulation->levels().level(0), 5);  // 5 m/s after half a base step
  one.push({{Vector3::Zero(), Vector3::Zero()}});
  one.simulation->advance();
  EXPECT_LT(one.simulation->snapshot().velocity[0].norm(), 1e-13);
}

TEST(outside_forces, a_resumed_run_has_the_same_bits) {
  for (const StepRules& rules : {StepRules{.base_step = 0.08},
                                 StepRules{.base_step = 0.04, .stability = false, .travel_length = 0.01, .neighbor_levels = 2}})
    for (const int before : {0, 7, 20}) {
      Pushed whole(test::ladder<3>(), rules), first(test::ladder<3>(), rules), second(test::ladder<3>(), rules);
      whole.push(changing(*whole.simulation));
      first.push(changing(*first.simulation));
      second.push(Loads(6, {Vector3(1, 1, 1), Vector3::Zero()}));  // whatever was given before it is read again
      whole.simulation->start();
      first.simulation->start();
      whole.run(30, changing);
      first.run(before, changing);
      test::MemoryArchive checkpoint;
      first.simulation->columns(checkpoint);
      checkpoint.turn_round();
      second.simulation->columns(checkpoint);
      second.run(30 - before, changing);
      EXPECT_EQ(test::distance(second.simulation->snapshot(), whole.simulation->snapshot()), 0);
      EXPECT_EQ(second.simulation->energy_balance().joules, whole.simulation->energy_balance().joules);
    }
}

TEST(outside_forces, there_is_one_for_each_body) {
  Pushed all(test::ladder<3>(), {.base_step = 0.08});
  EXPECT_THROW(all.push(Loads(5)), std::logic_error);
}

}  // namespace
}  // namespace sazare::levels
