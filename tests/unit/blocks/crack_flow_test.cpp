/// Flow of gas between vessels, against exact solutions for a gas of constant exponent.

#include "sazare/methods/blocks/charges/crack_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sazare/laws/explosives.hpp"
#include "sazare/methods/blocks/charges/collar.hpp"

namespace sazare::methods::blocks {
namespace {

constexpr Real exponent = 1.4;

FlowingGas ideal_gas(Real discharge = 1) {
  laws::Jwl law;
  law.omega = exponent - 1;
  return {law, 1000, discharge};
}

/// A hole with gas of 100 MPa.
GasVessel full(Real volume, Index openings) {
  GasVessel vessel{.volume = volume, .width = std::numeric_limits<Real>::infinity(), .mass = 100 * volume, .openings = openings};
  vessel.energy = 1e8 / (exponent - 1) * volume;
  ideal_gas().settle(vessel);
  return vessel;
}

GasVessel empty(Real volume, Real width, Index openings) {
  return {.volume = volume, .width = width, .mass = 0, .openings = openings};
}

TEST(crack_flow, has_the_pressure_and_the_sound_of_its_gas) {
  const GasVessel vessel = full(0.01, 1);
  EXPECT_NEAR(vessel.pressure, 1e8, 1e-6 * 1e8);
  EXPECT_NEAR(vessel.sound, std::sqrt(exponent * 1e8 / 100), 1e-9 * vessel.sound);
}

TEST(crack_flow, is_choked_below_the_critical_pressure_and_ends_with_the_difference) {
  const FlowingGas gas = ideal_gas(0.6);
  const GasVessel from = full(0.01, 1);
  const CollarGas collar{from.pressure, from.volume, from.energy, from.mass, exponent};
  const Real choked = mass_rate(gas, from, 0, 1e-4), critical = std::pow(2 / (exponent + 1), exponent / (exponent - 1));
  EXPECT_NEAR(choked, 0.6 * collar.outflow(1e-4), 1e-9 * choked);
  EXPECT_EQ(mass_rate(gas, from, 0.5 * critical * from.pressure, 1e-4), choked);
  EXPECT_NEAR(mass_rate(gas, from, 1.001 * critical * from.pressure, 1e-4), choked, 1e-5 * choked);
  const Real slight = 1e-4;  // then as a liquid: (2 p/V dp)^1/2
  EXPECT_NEAR(mass_rate(gas, from, (1 - slight) * from.pressure, 1e-4), 0.6e-4 * std::sqrt(2 * 100 * slight * from.pressure),
              1e-4 * choked);
  EXPECT_EQ(mass_rate(gas, from, from.pressure, 1e-4), 0);
}

/// A vessel with a hole empties as (1 + (k - 1)/2 t/T)^(-2 k/(k - 1)), T = V/(S c) ((k + 1)/2)^((k + 1)/(2 (k - 1))).
TEST(crack_flow, empties_a_vessel_as_the_exact_solution) {
  const Real k = exponent, length = 0.1, width = 1e-3;
  std::array<Real, 2> off;
  for (int fine = 0; fine < 2; ++fine) {
    std::vector<GasVessel> vessels = {full(0.01, 1)};
    vessels[0].width = width;
    const Real sound = vessels[0].sound;
    const Real unit = 0.01 / (length * width * sound) * std::pow((k + 1) / 2, (k + 1) / (2 * (k - 1)));
    const std::vector<Opening> openings = {{0, Opening::outside, length}};
    const int steps = fine == 0 ? 500 : 1000;
    GasAmount left;
    for (int i = 0; i < steps; ++i) {
      const GasAmount now = flow(ideal_gas(), vessels, openings, unit / steps);
      left.mass += now.mass;
      left.energy += now.energy;
    }
    const Real exact = 1e8 * std::pow(1 + (k - 1) / 2, -2 * k / (k - 1));
    off[static_cast<std::size_t>(fine)] = std::abs(vessels[0].pressure / exact - 1);
    EXPECT_NEAR(vessels[0].mass + left.mass, 1, 1e-12);
    EXPECT_NEAR(vessels[0].energy + left.energy, 1e8 / (k - 1) * 0.01, 1e-12 * 1e8);
  }
  EXPECT_LT(off[1], 1e-3);
  EXPECT_NEAR(off[0] / off[1], 2, 0.1);  // first order
}

/// Whatever the step, and in a real gas of an explosive too.
TEST(crack_flow, fills_cracks_up_to_the_pressure_of_the_hole_and_never_beyond) {
  for (const bool real : {false, true})
    for (const Real step : {1e-7, 1e-5, 1e-3}) {
      FlowingGas gas = ideal_gas(0.6);
      std::vector<GasVessel> vessels = {full(1e-3, 1)};
      if (real) {
        gas = {laws::explosives[0].gas, laws::explosives[0].density, 0.6};
        vessels[0].mass = gas.density * 1e-3;
        vessels[0].energy = laws::explosives[0].energy * 1e-3;
        gas.settle(vessels[0]);
      }
      const Real mass = vessels[0].mass, energy = vessels[0].energy;
      std::vector<Opening> openings;
      for (Index crack = 1; crack <= 20; ++crack) {
        vessels.push_back(empty(1e-4 * 0.01, 1e-4, crack < 20 ? 2 : 1));
        openings.push_back({crack, crack - 1, 0.1});
      }
      Real sum = 0, power = 0;
      for (int i = 0; i < 400; ++i) {
        flow(gas, vessels, openings, step);
        for (std::size_t v = 1; v < vessels.size(); ++v)
          EXPECT_LE(vessels[v].pressure, vessels[v - 1].pressure * (1 + 1e-3)) << step << ' ' << v;
      }
      for (const GasVessel& vessel : vessels) {
        sum += vessel.mass;
        power += vessel.energy;
        EXPECT_GE(vessel.mass, 0);
        EXPECT_GE(vessel.energy, 0);
      }
      EXPECT_NEAR(sum, mass, 1e-12 * mass);
      EXPECT_NEAR(power, energy, 1e-12 * energy);
      if (step == 1e-3) {
        EXPECT_NEAR(vessels.back().pressure, vessels.front().pressure, 0.02 * vessels.front().pressure);
      }
    }
}

TEST(crack_flow, goes_where_the_pressure_is_lower_whichever_way_an_opening_is_named) {
  const auto after = [](Opening opening) {
    std::vector<GasVessel> vessels = {full(1e-3, 1), empty(1e-6, 1e-4, 1)};
    flow(ideal_gas(), vessels, std::span(&opening, 1), 1e-6);
    return vessels[1].mass;
  };
  EXPECT_GT(after({0, 1, 0.1}), 0);
  EXPECT_EQ(after({0, 1, 0.1}), after({1, 0, 0.1}));
}

}  // namespace
}  // namespace sazare::methods::blocks
