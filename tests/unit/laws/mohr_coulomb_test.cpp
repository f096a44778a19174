#include "sazare/laws/mohr_coulomb.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace sazare::laws {
namespace {

constexpr Real degree = std::numbers::pi / 180;
const Elasticity ground{.shear_modulus = 8e7, .lame = 12e7};

template <std::size_t D>
std::array<Real, D> elastic_rest(const std::array<Real, D>& strain, const PlasticFlow<D>& flow) {
  std::array<Real, D> rest;
  for (std::size_t i = 0; i < D; ++i) rest[i] = strain[i] - flow.strain[i];
  return rest;
}

TEST(mohr_coulomb, leaves_what_it_bears_alone) {
  const auto law = MohrCoulomb::make(20e3, 30 * degree, 0, 5e3);
  const auto flow = plastic_flow<2>(law, ground, {1e-5, -1e-5});
  EXPECT_EQ(flow.slip, 0);
  EXPECT_EQ(flow.strain[0], 0);
}

TEST(mohr_coulomb, without_friction_yields_at_the_cohesion_and_keeps_the_volume) {
  const auto law = MohrCoulomb::make(20e3, 0, 0, 1e9);
  const Real strain = 20e3 / ground.shear_modulus;  // twice what it bears: shear stress 2 mu e
  const auto flow = plastic_flow<2>(law, ground, {strain, -strain});
  EXPECT_NEAR(flow.slip, strain, 1e-9 * strain);
  EXPECT_NEAR(flow.strain[0] + flow.strain[1], 0, 1e-15);
  const auto stress = ground.stress<2>(elastic_rest<2>({strain, -strain}, flow));
  EXPECT_NEAR(0.5 * (stress[0] - stress[1]), 20e3, 1e-3);
}

/// The largest axial stress under a confining stress p: (2 c cos + p (1 + sin))/(1 - sin).
TEST(mohr_coulomb, bears_the_stress_of_its_envelope_under_confinement) {
  const Real sine = std::sin(35 * degree), cosine = std::cos(35 * degree);
  const auto law = MohrCoulomb::make(10e3, 35 * degree, 0, 0);
  const Real pressed = -(2 * 10e3 * cosine + 50e3 * (1 + sine)) / (1 - sine);
  const Real mean = 0.5 * (pressed - 50e3) / (ground.lame + ground.shear_modulus) / 2,
             half = 0.25 * (-50e3 - pressed) / ground.shear_modulus;
  const std::array<Real, 2> at_limit{mean + half, mean - half};
  EXPECT_NEAR(ground.stress<2>(at_limit)[0], -50e3, 1e-6);
  EXPECT_NEAR(ground.stress<2>(at_limit)[1], pressed, 1e-6);
  EXPECT_EQ(plastic_flow<2>(law, ground, {mean + 0.999999 * half, mean - 0.999999 * half}).slip, 0);
  EXPECT_GT(plastic_flow<2>(law, ground, {mean + 1.000001 * half, mean - 1.000001 * half}).slip, 0);
}

TEST(mohr_coulomb, opens_across_the_tension_that_it_does_not_bear) {
  const auto law = MohrCoulomb::make(1e6, 30 * degree, 0, 4e3);
  const std::array<Real, 2> strain{3e-4, 0};
  const auto flow = plastic_flow<2>(law, ground, strain);
  EXPECT_GT(flow.strain[0], 0);
  EXPECT_EQ(flow.slip, flow.strain[0]);
  EXPECT_NEAR(ground.stress<2>(elastic_rest<2>(strain, flow))[0], 4e3, 1e-3);
}

TEST(mohr_coulomb, grows_in_volume_as_the_dilation_says) {
  const Real sine = std::sin(10 * degree);
  const auto law = MohrCoulomb::make(10e3, 30 * degree, 10 * degree, 0);
  const auto flow = plastic_flow<2>(law, ground, {1.5e-3, -3e-3});
  EXPECT_NEAR((flow.strain[0] + flow.strain[1]) / flow.slip, sine, 1e-9);
}

/// Whatever the strain: afterwards the stress lies in the strength, and energy was spent.
template <std::size_t D>
void expect_return_from_anywhere() {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> number(-1e-3, 1e-3), angle(0, 40 * degree);
  for (int i = 0; i < 2000; ++i) {
    const Real friction = angle(random), cohesion = 40e6 * std::abs(number(random));
    const auto law = MohrCoulomb::make(cohesion, friction, 0.5 * friction, 0.3 * cohesion);
    std::array<Real, D> strain;
    for (Real& part : strain) part = number(random);
    const auto flow = plastic_flow<D>(law, ground, strain);
    auto stress = ground.stress<D>(elastic_rest<D>(strain, flow));
    Real work = 0;
    for (std::size_t axis = 0; axis < D; ++axis) work += stress[axis] * flow.strain[axis];
    EXPECT_GE(work, -(1e-3 * cohesion + 1) * flow.slip);  // within the error of the stress below
    std::ranges::sort(stress);
    EXPECT_LE(law.shear(stress[D - 1], stress[0]), 1e-3 * cohesion + 1) << i;
    EXPECT_LE(law.tension(stress[D - 1]), 1e-3 * cohesion + 1) << i;
  }
}

TEST(mohr_coulomb, returns_from_anywhere_in_the_plane) { expect_return_from_anywhere<2>(); }
TEST(mohr_coulomb, returns_from_anywhere_in_space) { expect_return_from_anywhere<3>(); }

}  // namespace
}  // namespace sazare::laws
