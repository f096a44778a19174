#include "sazare/laws/cohesion_softening.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace sazare::laws {
namespace {

constexpr Real degree = std::numbers::pi / 180;
const Elasticity ground{.shear_modulus = 8e7, .lame = 12e7};

template <std::size_t D>
std::array<Real, D> less(std::array<Real, D> strain, const PlasticFlow<D>& flow) {
  for (std::size_t i = 0; i < D; ++i) strain[i] -= flow.strain[i];
  return strain;
}

TEST(cohesion_softening, falls_in_a_line_to_the_residual_cohesion_and_takes_the_tension_with_it) {
  const auto peak = MohrCoulomb::make(20e3, 30 * degree, 0, 8e3);
  const CohesionSoftening softening{5e3, 0.02};
  EXPECT_EQ(softening.at(peak, 0).cohesion, 20e3);
  EXPECT_EQ(softening.at(peak, 0).tensile_strength, 8e3);
  EXPECT_NEAR(softening.at(peak, 0.01).cohesion, 12.5e3, 1e-9);
  EXPECT_NEAR(softening.at(peak, 0.01).tensile_strength, 5e3, 1e-9);
  EXPECT_NEAR(softening.at(peak, 0.02).cohesion, 5e3, 1e-9);
  EXPECT_EQ(softening.at(peak, 7).cohesion, softening.at(peak, 0.02).cohesion);
  EXPECT_EQ(softening.at(peak, 7).sin_friction, peak.sin_friction);
  const CohesionSoftening to_nothing{0, 0.02};
  EXPECT_EQ(to_nothing.at(MohrCoulomb::make(20e3, 0, 0, {}), 1).tensile_strength, std::numeric_limits<Real>::infinity());
}

/// A strip in pure shear without friction, in small steps and in one: the stress is what is left after all slip.
TEST(cohesion_softening, leaves_the_stress_at_the_strength_that_is_left) {
  const auto peak = MohrCoulomb::make(20e3, 0, 0, 1e9);
  const CohesionSoftening softening{4e3, 0.01};
  const auto shear_to = [&](Real half, int steps) {
    std::array<Real, 2> plastic{};
    Real slip = 0;
    for (int step = 1; step <= steps; ++step) {
      const Real part = half * step / steps;
      const std::array<Real, 2> elastic{part - plastic[0], -part - plastic[1]};
      const auto flow = softening_flow<2>(peak, softening, ground, slip, elastic);
      for (std::size_t i = 0; i < 2; ++i) plastic[i] += flow.strain[i];
      slip += flow.slip;
    }
    const auto stress = ground.stress<2>({half - plastic[0], -half - plastic[1]});
    EXPECT_NEAR(0.5 * (stress[0] - stress[1]), softening.at(peak, slip).cohesion, 1) << half << ", " << steps << " steps";
    return slip;
  };
  for (const Real half : {1e-3, 3e-3, 8e-3}) {
    const Real slip = shear_to(half, 1);
    EXPECT_GT(slip, 0);
    EXPECT_NEAR(shear_to(half, 50), slip, 1e-6 * slip);
  }
}

template <std::size_t D>
void expect_dissipation_and_strength_from_anywhere() {
  std::mt19937 numbers(3);
  std::uniform_real_distribution<Real> anywhere(-1, 1), share(0, 1);
  int flowed = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Real cohesion = 30e3 * share(numbers), friction = 45 * degree * share(numbers);
    const auto peak = MohrCoulomb::make(cohesion, friction, friction * share(numbers), {});
    const CohesionSoftening softening{cohesion * share(numbers), 5e-3 + share(numbers)};
    const Real slip = 1.2 * softening.strain * share(numbers);
    std::array<Real, D> strain;
    for (Real& part : strain) part = 3e-3 * anywhere(numbers);
    const auto flow = softening_flow<D>(peak, softening, ground, slip, strain);
    if (flow.slip == 0) continue;
    ++flowed;
    auto stress = ground.stress<D>(less<D>(strain, flow));
    const auto [least, most] = std::minmax_element(stress.begin(), stress.end());
    const auto left = softening.at(peak, slip + flow.slip);
    EXPECT_LT(left.shear(*most, *least), 1e-3 * (cohesion + 1e3)) << trial;
    EXPECT_LT(left.tension(*most), 1e-3 * (cohesion + 1e3)) << trial;
    Real power = 0;
    for (std::size_t i = 0; i < D; ++i) power += stress[i] * flow.strain[i];
    EXPECT_GE(power, -1e-6 * (cohesion + 1e3) * flow.slip) << trial;
  }
  EXPECT_GT(flowed, 1000);
}

TEST(cohesion_softening, dissipates_and_stays_within_the_strength_from_anywhere) {
  expect_dissipation_and_strength_from_anywhere<2>();
  expect_dissipation_and_strength_from_anywhere<3>();
}

TEST(cohesion_softening, without_it_is_perfectly_plastic_to_the_bit) {
  const auto peak = MohrCoulomb::make(20e3, 25 * degree, 5 * degree, 2e3);
  const std::array<Real, 3> strain{1e-3, -3e-4, -2e-3};
  const auto flow = softening_flow<3>(peak, {}, ground, 0.3, strain), plastic = plastic_flow<3>(peak, ground, strain);
  EXPECT_GT(flow.slip, 0);
  EXPECT_EQ(flow.slip, plastic.slip);
  EXPECT_EQ(flow.strain, plastic.strain);
}

}  // namespace
}  // namespace sazare::laws
