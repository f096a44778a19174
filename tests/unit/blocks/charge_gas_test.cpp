/// Gas of a charge on the wall of its hole: a ring of pieces that nothing holds, and its exact motion.

#include "sazare/methods/blocks/charges/charge_gas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "sazare/laws/explosives.hpp"
#include "sazare/levels/simulation.hpp"

namespace sazare::methods::blocks {
namespace {

constexpr Real radius = 0.05, row_height = 0.1;
constexpr Real never = 1e9;  // a velocity with which all detonates at once [m/s]

struct Ring {
  int around = 12, rows = 1;
  Real mass = 0.5;      // of a piece [kg]
  Real light_mass = 0;  // of every second piece, 0: the same
  Real velocity = never;
  Real charge_share = 1;  // of the area of the hole
  Real cut_distance = std::numeric_limits<Real>::infinity();
  Real primer = 0;
  Real delay = 0;
  bool vents = false;
  Real stemming = 0;
};

/// A simulation of a ring, with its gas.
struct Blown {
  std::unique_ptr<levels::Simulation<3>> simulation;
  ChargeGas* gas = nullptr;
  Charge charge;

  void run_until(
      Real time, const std::function<void()>& each = [] {}) {
    while (simulation->now().seconds() < time * (1 - 1e-12)) {
      simulation->advance();
      each();
    }
  }
  /// How far a piece has moved out [m].
  Real moved(std::size_t piece) const {
    const auto now = simulation->snapshot();
    return std::hypot(now.pose[piece].position.x(), now.pose[piece].position.y()) - 2 * radius;
  }
  ChargeState state() const { return gas->states(simulation->now().seconds()).front(); }
};

Blown blow(const Ring& ring, Real base_step, bool uniform = true) {
  state::Bodies<3> bodies;
  std::vector<ChargedFace> faces;
  const Real face_area = 2 * std::numbers::pi * radius * row_height / ring.around;
  for (int row = 0; row < ring.rows; ++row)
    for (int i = 0; i < ring.around; ++i) {
      const Real angle = 2 * std::numbers::pi * i / ring.around;
      const Vector3 out(std::cos(angle), std::sin(angle), 0), height(0, 0, (row + 0.5) * row_height);
      const Real mass = i % 2 == 1 && ring.light_mass > 0 ? ring.light_mass : ring.mass;
      ChargedFace face;
      face.body = state::add_body(bodies, mass, 2 * radius * out + height, Vector3(1, 1, 1), Quaternion::Identity(), radius);
      face.area = -face_area * out;
      face.centre = -radius * out;
      face.start = radius * out + height;
      face.part = {row * row_height, (row + 1) * row_height};
      faces.push_back(face);
    }
  Blown made;
  const Real hole = std::numbers::pi * radius * radius;
  made.charge = {.gas = laws::explosives[0].gas,
                 .energy = laws::explosives[0].energy,
                 .density = laws::explosives[0].density,
                 .velocity = ring.velocity,
                 .area = ring.charge_share * hole,
                 .hole_area = hole,
                 .collar = {ring.vents, hole, 2 * radius, ring.stemming, 1600, 0},
                 .filled = {0, ring.rows * row_height},
                 .primer = ring.primer,
                 .delay = ring.delay,
                 .cut_distance = ring.cut_distance};
  auto gas = std::make_unique<ChargeGas>(std::vector{made.charge}, faces, bodies);
  made.gas = gas.get();
  levels::TermList<3> terms;
  terms.push_back(std::move(gas));
  levels::StepRules rules;
  rules.base_step = base_step;
  rules.uniform = uniform;
  made.simulation = std::make_unique<levels::Simulation<3>>(std::move(bodies), std::move(terms), rules);
  made.simulation->start();
  return made;
}

/// How far the pieces of a ring that detonates at once have moved [m], and their speed [m/s], by the method of Runge and Kutta.
std::array<Real, 2> exact(const Ring& ring, Real time) {
  const Real wall = 2 * std::numbers::pi * radius * row_height, hole = std::numbers::pi * radius * radius * row_height;
  const Real start = 1 / ring.charge_share;
  const auto& explosive = laws::explosives[0];
  const auto acceleration = [&](Real out) {
    const Real volume = (hole + wall * out) / (ring.charge_share * hole);
    const Real energy = laws::jwl_expanded_energy(explosive.gas, start, explosive.energy, volume);
    return laws::jwl_pressure(explosive.gas, volume, energy) * wall / (ring.around * ring.mass);
  };
  constexpr int steps = 20000;
  const Real h = time / steps;
  Real x = 0, v = 0;
  for (int i = 0; i < steps; ++i) {
    const Real a1 = acceleration(x), a2 = acceleration(x + h / 2 * v), a3 = acceleration(x + h / 2 * (v + h / 2 * a1)),
               a4 = acceleration(x + h * (v + h / 2 * a2));
    x += h * (v + h / 6 * (a1 + a2 + a3));
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return {x, v};
}

Real kinetic(const Blown& blown) {
  return blown.simulation->energy_balance(blown.simulation->snapshot())[terms::EnergyKind::kinetic];
}

TEST(charge_gas, drives_its_wall_as_the_expansion_of_the_gas_says) {
  for (const Real share : {1.0, 0.5}) {
    Ring ring{.charge_share = share};
    const Real time = 8e-5;
    std::array<Real, 2> off;
    for (int fine = 0; fine < 2; ++fine) {
      const Real step = fine == 0 ? 5e-7 : 2.5e-7;
      ring.delay = step / 2;  // a force acts from the middle between two evaluations
      const Real exact_path = exact(ring, time - ring.delay)[0];
      EXPECT_GT(exact_path, 0.1 * radius);
      Blown blown = blow(ring, step);
      blown.run_until(time);
      off[static_cast<std::size_t>(fine)] = std::abs(blown.moved(0) / exact_path - 1);
      EXPECT_NEAR(blown.moved(0), blown.moved(7), 1e-9 * exact_path);
    }
    EXPECT_LT(off[1], 1e-4);
    EXPECT_GT(off[0] / off[1], 3.2);  // second order
  }
}

TEST(charge_gas, follows_the_isentrope_once_it_has_detonated) {
  const Ring ring;
  Blown blown = blow(ring, 2e-7);
  blown.run_until(6e-5);
  const ChargeState state = blown.state();
  const Real volume = state.volume / (blown.charge.area * row_height);
  const Real energy = laws::jwl_expanded_energy(blown.charge.gas, 1, blown.charge.energy, volume);
  EXPECT_GT(volume, 1.5);
  EXPECT_NEAR(state.pressure, laws::jwl_pressure(blown.charge.gas, volume, energy), 2e-3 * state.pressure);
  EXPECT_NEAR(state.released - state.work, energy * blown.charge.area * row_height, 1e-3 * state.released);
}

/// Work as the gas counts it is what the pieces have gained.
TEST(charge_gas, gives_its_pieces_the_energy_that_it_loses) {
  for (const bool uniform : {true, false}) {
    const Ring ring{.rows = 3, .light_mass = 0.03, .velocity = 4000, .primer = 0.3};
    std::array<Real, 2> off;
    for (int fine = 0; fine < 2; ++fine) {
      Blown blown = blow(ring, fine == 0 ? 8e-7 : 4e-7, uniform);
      Real most = 0;
      blown.run_until(2e-4, [&] { most = std::max(most, blown.state().work); });
      off[static_cast<std::size_t>(fine)] = std::abs(kinetic(blown) / blown.state().work - 1);
      EXPECT_LT(most, blown.state().released);
      EXPECT_GT(most, 0.5 * blown.state().released);
    }
    EXPECT_LT(off[1], 1e-3) << uniform;
    EXPECT_LT(off[1], off[0]) << uniform;
  }
}

TEST(charge_gas, arrives_with_the_detonation) {
  const Ring ring{.rows = 5, .velocity = 2000, .primer = 0.5};  // at the bottom; the first row is the farthest
  Blown blown = blow(ring, 1e-7);
  std::array<Real, 5> arrived{};
  blown.run_until(3.5e-4, [&] {
    const auto now = blown.simulation->snapshot();
    for (std::size_t row = 0; row < 5; ++row)
      if (arrived[row] == 0 && now.velocity[row * 12].norm() > 0) arrived[row] = blown.simulation->now().seconds();
  });
  for (std::size_t row = 0; row < 5; ++row) EXPECT_NEAR(arrived[row], (4.0 - row) * row_height / 2000, 5e-7) << row;
}

TEST(charge_gas, releases_what_the_charge_holds_and_no_more) {
  const Ring ring{.rows = 4, .velocity = 2000, .primer = 0.1};
  Blown blown = blow(ring, 1e-6);
  const Real per_length = blown.charge.energy * blown.charge.area;
  blown.run_until(2.5e-5);
  EXPECT_NEAR(blown.state().released, per_length * 2 * 0.05, 1e-9 * per_length);  // both ways
  blown.run_until(1e-4);
  EXPECT_NEAR(blown.state().released, per_length * (0.1 + 0.2), 1e-9 * per_length);  // the short end is burnt
  blown.run_until(3e-4);
  EXPECT_NEAR(blown.state().released, per_length * 0.4, 1e-9 * per_length);
}

TEST(charge_gas, keeps_momentum) {
  Blown blown = blow({.rows = 2, .velocity = 3000}, 1e-6);
  blown.run_until(1e-4);
  const auto now = blown.simulation->snapshot();
  Vector3 sum = Vector3::Zero();
  Real all = 0;
  for (std::size_t i = 0; i < now.velocity.size(); ++i) {
    sum += now.velocity[i];
    all += now.velocity[i].norm();
  }
  EXPECT_LT(sum.norm(), 1e-12 * all);
}

TEST(charge_gas, leaves_a_face_for_good_once_it_is_far_out) {
  Blown blown = blow({.cut_distance = 0.002}, 1e-7);
  blown.run_until(5e-5);
  const auto first = blown.simulation->snapshot().velocity[0];
  const Real work = blown.state().work;
  blown.run_until(1e-4);
  EXPECT_GT(blown.moved(0), 0.002);
  EXPECT_EQ(blown.simulation->snapshot().velocity[0], first);
  EXPECT_NEAR(blown.state().work, work, 1e-9 * work);
}

TEST(charge_gas, leaves_through_an_open_collar_once_the_detonation_is_there) {
  const Ring ring{.rows = 4, .mass = 1e6, .velocity = 4000, .primer = 0.4, .vents = true};
  Blown blown = blow(ring, 1e-7);
  blown.run_until(9.9e-5);
  EXPECT_EQ(blown.state().lost, 0);
  blown.run_until(2e-4);
  const ChargeState state = blown.state();
  EXPECT_GT(state.lost, 0.05 * state.released);
  EXPECT_LT(state.mass, 0.95 * blown.charge.density * blown.charge.area * 0.4);
  EXPECT_NEAR(state.energy(), state.released - state.work - state.lost, 1e-9 * state.released);
}

TEST(charge_gas, pushes_its_stemming_out_before_it_leaves) {
  const Ring ring{.rows = 4, .mass = 1e6, .primer = 0.4, .vents = true, .stemming = 0.3};
  Blown blown = blow(ring, 1e-6);
  const Real full = blown.charge.density * blown.charge.area * 0.4;
  blown.run_until(1e-4);
  EXPECT_GT(blown.state().lost, 0);
  EXPECT_NEAR(blown.state().mass, full, 1e-9 * full);
  blown.run_until(2e-3);
  EXPECT_LT(blown.state().mass, 0.9 * full);
}

}  // namespace
}  // namespace sazare::methods::blocks
