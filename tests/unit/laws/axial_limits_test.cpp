#include <gtest/gtest.h>

#include <random>

#include "sazare/laws/members/axial_limits.hpp"

namespace sazare::laws {
namespace {

const AxialLimits steel{1e8, 2e4, 5e4, {}}, buckles{1e8, 2e4, 5e4, 1e4}, slack{1e8, 0, 5e4, 0.0};

TEST(axial_limits, yield_in_tension_and_in_compression) {
  const auto pulled = respond(steel, 1e-3, 0);
  EXPECT_EQ(pulled.force, 5e4);
  EXPECT_NEAR(pulled.plastic, 1e-3 - 3e-4, 1e-12);
  EXPECT_EQ(pulled.tangent, 0);
  const auto back = respond(steel, 9e-4, pulled.plastic);
  EXPECT_NEAR(back.force, 4e4, 1e-6);
  EXPECT_EQ(back.plastic, pulled.plastic);
  EXPECT_EQ(respond(steel, -1e-3, pulled.plastic).force, -5e4);
  EXPECT_LT(respond(steel, -1e-3, pulled.plastic).plastic, pulled.plastic);
}

TEST(axial_limits, forget_a_compression_in_which_they_gave_way) {
  for (const AxialLimits& law : {buckles, slack}) {
    const auto pressed = respond(law, -5e-3, 1e-4);
    EXPECT_EQ(pressed.force, -*law.compression);
    EXPECT_EQ(pressed.plastic, 1e-4);
    EXPECT_EQ(respond(law, 2e-4, pressed.plastic).force, law.prestress + 1e4);
  }
}

TEST(axial_limits, have_a_force_that_is_the_slope_of_their_energy) {
  for (const AxialLimits& law : {steel, buckles, slack})
    for (const Real elongation : {-4e-4, -2.5e-4, 1e-4, 2e-4}) {
      const Real step = 1e-9;
      const auto here = respond(law, elongation, 0);
      if (here.plastic != 0) continue;
      const Real slope = (respond(law, elongation + step, 0).energy - respond(law, elongation - step, 0).energy) / (2 * step);
      EXPECT_NEAR(slope, here.force, 1e-3 + 1e-6 * std::abs(here.force));
    }
}

/// On any way the work of the force at the end of each step is at least what is stored: nothing is ever gained.
TEST(axial_limits, never_gain) {
  std::mt19937 random(7);
  std::normal_distribution<Real> step(0, 3e-4);
  for (const AxialLimits& law : {steel, buckles, slack}) {
    Real elongation = 0, plastic = 0, dissipated = 0, energy = 0;
    for (int i = 0; i < 2000; ++i) {
      const Real moved = step(random) - 0.05 * elongation;
      elongation += moved;
      const auto now = respond(law, elongation, plastic);
      const Real lost = now.force * moved - (now.energy - energy);
      EXPECT_GE(lost, -1e-9);
      EXPECT_LE(now.force, law.yield);
      dissipated += now.force * (now.plastic - plastic);
      plastic = now.plastic;
      energy = now.energy;
    }
    EXPECT_GT(dissipated, 0);
  }
}

}  // namespace
}  // namespace sazare::laws
