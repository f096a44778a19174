/// Stemming and outflow at the collar of a hole, against exact solutions for a gas of constant exponent in a rigid hole.

#include "sazare/methods/blocks/charges/collar.hpp"

#include <gtest/gtest.h>

namespace sazare::methods::blocks {
namespace {

constexpr Real exponent = 1.4, area = 0.01, diameter = 0.1128, volume = 0.05, energy = 50e6, mass = 40;

/// A rigid hole with a gas of constant exponent, taken on in equal steps.
struct Hole {
  Collar collar;
  CollarState state = {};

  CollarGas gas() const {
    const Real left = energy - state.lost_energy, room = volume + area * std::min(state.moved, collar.length);
    return {(exponent - 1) * left / room, room, left, mass - state.lost_mass, exponent};
  }
  /// The gas after a step is found from the state by its rates, as charges do.
  void run(Real until, int steps) {
    const Real begin = state.time;
    if (begin == 0) state.pressure = gas().pressure;
    for (int i = 1; i <= steps; ++i) {
      const Real time = begin + (until - begin) * i / steps;
      Hole later = *this;
      later.state = state.at(time);
      step(collar, state, later.gas(), time);
    }
  }
};

Hole stemmed(Real resistance) { return {{true, area, diameter, 2, 1600, resistance}}; }

TEST(collar, stemming_leaves_with_the_energy_that_the_gas_gives_it) {
  Hole hole = stemmed(0);
  while (!hole.state.is_open(hole.collar)) hole.run(hole.state.time + 1e-6, 1);
  const Real room = volume + area * 2;
  const Real given = energy * (1 - std::pow(volume / room, exponent - 1));
  EXPECT_NEAR(hole.state.lost_energy, given, 1e-3 * given);
  EXPECT_NEAR(0.5 * 1600 * area * 2 * hole.state.velocity * hole.state.velocity, given, 1e-3 * given);
}

TEST(collar, stemming_is_late_by_its_inertia) {
  Hole hole = stemmed(0);
  const Real pressure = (exponent - 1) * energy / volume, time = 1e-4;
  hole.run(time, 100);
  const Real acceleration = pressure / (1600 * 2);
  EXPECT_NEAR(hole.state.moved, 0.5 * acceleration * time * time, 5e-3 * hole.state.moved);
}

TEST(collar, sliding_takes_its_part_of_the_energy) {
  const Real resistance = 0.5e6;
  Hole hole = stemmed(resistance);
  while (!hole.state.is_open(hole.collar)) hole.run(hole.state.time + 1e-6, 1);
  const Real slid = resistance * 4 * area / diameter * 2 * 2 / 2;  // over a length that falls from 2 m to none
  const Real kinetic = 0.5 * 1600 * area * 2 * hole.state.velocity * hole.state.velocity;
  EXPECT_NEAR(hole.state.lost_energy, kinetic + slid, 1e-3 * hole.state.lost_energy);
  EXPECT_GT(slid, 0.02 * kinetic);
}

TEST(collar, stemming_that_is_held_fast_stays) {
  Hole hole = stemmed(50e6);
  hole.run(1, 1000);
  EXPECT_EQ(hole.state.moved, 0);
  EXPECT_EQ(hole.state.lost_energy, 0);
}

TEST(collar, an_open_hole_empties_as_a_vessel_through_a_nozzle) {
  Hole hole{{true, area, diameter, 0, 0, 0}};
  const CollarGas full = hole.gas();
  const Real sound = std::sqrt(exponent * full.pressure * volume / mass);
  const Real flow = std::pow(2 / (exponent + 1), (exponent + 1) / (2 * (exponent - 1)));
  for (const Real time : {0.005, 0.02, 0.05}) {
    hole.run(time, 2000);
    const Real exact = std::pow(1 + (exponent - 1) / 2 * area * sound * flow * time / volume, -2 / (exponent - 1));
    EXPECT_NEAR(hole.gas().mass / mass, exact, 1e-3 * exact) << time;
    EXPECT_NEAR(hole.gas().energy / energy, std::pow(exact, exponent), 2e-3 * exact) << time;
  }
  EXPECT_LT(hole.gas().mass, 0.5 * mass);
}

TEST(collar, a_closed_one_loses_nothing) {
  Hole hole{{false, area, diameter, 0, 0, 0}};
  EXPECT_FALSE(hole.state.is_open(hole.collar));
}

}  // namespace
}  // namespace sazare::methods::blocks
