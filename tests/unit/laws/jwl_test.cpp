#include "sazare/laws/jwl.hpp"

#include <gtest/gtest.h>

#include "sazare/laws/explosives.hpp"

namespace sazare::laws {
namespace {

/// Pressure where a gas has expanded to from its explosive, which burnt without room to expand.
Real expanded_pressure(const Explosive& explosive, Real volume) {
  return jwl_pressure(explosive.gas, volume, jwl_expanded_energy(explosive.gas, 1, explosive.energy, volume));
}

TEST(Jwl, PressureIsTheSlopeOfTheEnergyAlongTheExpansion) {
  for (const Explosive& explosive : explosives)
    for (const Real volume : {1.0, 1.5, 3.0, 10.0, 100.0}) {
      const Real step = 1e-5 * volume;
      const Real slope = (jwl_expanded_energy(explosive.gas, 1, explosive.energy, volume + step) -
                          jwl_expanded_energy(explosive.gas, 1, explosive.energy, volume - step)) /
                         (2 * step);
      EXPECT_NEAR(expanded_pressure(explosive, volume), -slope, 1e-7 * -slope) << explosive.name << " " << volume;
    }
}

TEST(Jwl, ExponentIsThatOfTheExpansion) {
  for (const Explosive& explosive : explosives)
    for (const Real volume : {1.0, 2.0, 8.0}) {
      const Real step = 1e-5;
      const Real slope = (std::log(expanded_pressure(explosive, volume * (1 + step))) -
                          std::log(expanded_pressure(explosive, volume * (1 - step)))) /
                         (2 * step);
      const Real energy = jwl_expanded_energy(explosive.gas, 1, explosive.energy, volume);
      EXPECT_NEAR(jwl_exponent(explosive.gas, volume, energy), -slope, 1e-6) << explosive.name << " " << volume;
    }
}

TEST(Jwl, AGasWithoutTheFirstTermsHasAConstantExponent) {
  const Jwl gas{0, 0, 1, 1, 2};
  const Real start = jwl_pressure(gas, 1, 1e9);
  EXPECT_DOUBLE_EQ(start, 2e9);
  EXPECT_NEAR(jwl_pressure(gas, 2, jwl_expanded_energy(gas, 1, 1e9, 2)), start / 8, 1e-6 * start);
}

TEST(Jwl, AllEnergyIsGivenInTheEnd) {
  for (const Explosive& explosive : explosives)
    EXPECT_LT(jwl_expanded_energy(explosive.gas, 1, explosive.energy, 1e9), 0.01 * explosive.energy) << explosive.name;
}

TEST(Explosives, RowsFulfilTheLawsOfDetonation) {
  for (const Explosive& explosive : explosives) EXPECT_LT(detonation_mismatch(explosive), 0.02) << explosive.name;
}

/// In a gas of constant exponent the front compresses to V = g/(g + 1).
TEST(Explosives, AVelocityGivesTheEnergyOfAGasOfConstantExponent) {
  for (const Real exponent : {2.5, 3.0}) {
    const Explosive explosive{"", 1100, 5000, 1100 * energy_by_velocity(5000, exponent), {0, 0, 1, 1, exponent - 1}};
    EXPECT_LT(detonation_mismatch(explosive), 5e-3);
    Explosive stronger = explosive;
    stronger.energy *= 1.3;
    EXPECT_GT(detonation_mismatch(stronger), 0.05);
  }
}

/// The pressure in a hole that is filled with such an explosive, 1/8 of density D^2 at an exponent of 3, is a rule of blasters.
TEST(Explosives, PressureInAFilledHoleIsHalfOfThatAtTheFront) {
  const Real energy = 1100 * energy_by_velocity(5000, 3);
  EXPECT_NEAR(jwl_pressure({0, 0, 1, 1, 2}, 1, energy), 1100 * 5000.0 * 5000.0 / 8, 1);
}

}  // namespace
}  // namespace sazare::laws
