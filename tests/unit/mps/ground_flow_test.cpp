#include "sazare/laws/ground_flow.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/mps/column.hpp"

namespace sazare::laws {
namespace {

using methods::mps::Noise;

constexpr Real degree = std::numbers::pi / 180;
constexpr Elasticity elastic{.shear_modulus = 1e7, .lame = 1.5e7};

template <int D>
Rotation<D> noise_tensor(Noise& noise, Real size) {
  Rotation<D> tensor;
  for (int i = 0; i < D; ++i)
    for (int k = 0; k < D; ++k) tensor(i, k) = size * noise();
  return tensor;
}

template <int D>
Rotation<D> symmetric(const Rotation<D>& tensor) {
  return 0.5 * (tensor + tensor.transpose());
}

/// Pressed together by p.
template <int D>
GroundState<D> pressed(Real pressure) {
  return {-pressure * Rotation<D>::Identity(), 0};
}

template <int D>
void expect_work_to_be_stored_or_dissipated() {
  const MohrCoulomb law = MohrCoulomb::make(0, 30 * degree, 0, 0);
  Noise noise;
  GroundState<D> state = pressed<D>(1e4);
  Real work = 0, dissipated = 0, largest = 0;
  const Real before = elastic_energy<D>(elastic, state.stress);
  for (int step = 0; step < 2000; ++step) {
    const Rotation<D> strain = symmetric<D>(noise_tensor<D>(noise, 2e-4));
    const Rotation<D> old = state.stress;
    const auto done = advance_ground<D>(law, elastic, strain, Rotation<D>::Zero(), state);
    work += 0.5 * (old + state.stress).cwiseProduct(strain).sum();
    dissipated += done.dissipated;
    EXPECT_GE(state.stress.cwiseProduct(done.plastic).sum(), -1e-9) << step;  // the stress resists the flow
    const Vector<D> principal = Eigen::SelfAdjointEigenSolver<Rotation<D>>(state.stress).eigenvalues();
    largest = std::max(largest, law.shear(principal[D - 1], principal[0]));
    EXPECT_TRUE(state.opening == 0 || state.stress.norm() == 0) << step;
  }
  EXPECT_LT(largest, 1);
  EXPECT_NEAR(elastic_energy<D>(elastic, state.stress) - before + dissipated, work, 1e-9 * std::abs(dissipated));
}

TEST(ground_flow, stores_or_dissipates_its_work_within_the_strength) {
  expect_work_to_be_stored_or_dissipated<2>();
  expect_work_to_be_stored_or_dissipated<3>();
}

TEST(ground_flow, turns_with_a_rigid_rotation) {
  GroundState<2> state;
  state.stress << -3e4, 2e3, 2e3, -2e4;
  const Rotation<2> first = state.stress;
  Rotation<2> spin;
  const Real part = 2 * std::tan(0.5 * std::numbers::pi / 2 / 100);  // of the hundredth of a right angle, about the middle
  spin << 0, -part, part, 0;
  for (int step = 0; step < 100; ++step)
    advance_ground<2>(MohrCoulomb::make(0, 30 * degree, 0, 0), elastic, Rotation<2>::Zero(), spin, state);
  EXPECT_NEAR(state.stress(0, 0), first(1, 1), 1e-6);
  EXPECT_NEAR(state.stress(1, 1), first(0, 0), 1e-6);
  EXPECT_NEAR(state.stress(0, 1), -first(0, 1), 1e-6);
}

/// Between plates that press with what they pressed at the beginning, as on a plane of sliding.
TEST(ground_flow, slides_on_a_plane_with_the_tangent_of_its_friction_angle) {
  for (const Real angle : {20.0, 30.0, 40.0}) {
    GroundState<2> state;
    state.stress << -5e3, 0, 0, -1e4;
    const Real modulus = elastic.lame + 2 * elastic.shear_modulus;
    for (int step = 0; step < 4000; ++step) {
      Rotation<2> strain, spin;
      const Real sheared = 1e-5, thicker = (1e4 + state.stress(1, 1)) / -modulus;  // keeps the pressure
      strain << 0, 0.5 * sheared, 0.5 * sheared, thicker;
      spin << 0, 0.5 * sheared, -0.5 * sheared, 0;
      advance_ground<2>(MohrCoulomb::make(0, angle * degree, 0, 0), elastic, strain, spin, state);
    }
    EXPECT_NEAR(state.stress(0, 1) / -state.stress(1, 1), std::tan(angle * degree), 0.01 * std::tan(angle * degree)) << angle;
  }
}

TEST(ground_flow, carries_nothing_until_its_gaps_have_closed) {
  const MohrCoulomb law = MohrCoulomb::make(0, 30 * degree, 0, 0);
  GroundState<2> state = pressed<2>(1e3);
  const auto swell = [&](Real by) {
    advance_ground<2>(law, elastic, 0.5 * by * Rotation<2>::Identity(), Rotation<2>::Zero(), state);
  };
  swell(0.01);
  EXPECT_EQ(state.stress.norm(), 0);
  swell(-0.009);
  EXPECT_EQ(state.stress.norm(), 0);
  swell(-0.001);
  EXPECT_NEAR(state.stress.trace(), -2e3, 1e-6);
  EXPECT_EQ(state.opening, 0);
}

}  // namespace
}  // namespace sazare::laws
