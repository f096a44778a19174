#include "sazare/laws/joint_shear.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sazare::laws {
namespace {

const JointShear concrete{90e9, 6.66e6, 0.58};

Real length(const Slip<Real>& at) { return std::hypot(at.elastic[0], at.elastic[1]); }

TEST(joint_shear, strength_follows_coulomb_and_is_never_negative) {
  EXPECT_DOUBLE_EQ(shear_strength(concrete, 0.0), 6.66e6);
  EXPECT_DOUBLE_EQ(shear_strength(concrete, -10e6), 6.66e6 + 0.58 * 10e6);  // compression helps
  EXPECT_DOUBLE_EQ(shear_strength(concrete, 5e6), 6.66e6 - 0.58 * 5e6);
  EXPECT_EQ(shear_strength(concrete, 6.66e6 / 0.58 * 1.01), 0);
}

TEST(joint_shear, slips_only_beyond_the_strength) {
  const Real limit = 6.66e6 / 90e9;
  EXPECT_FALSE(slips(concrete, Slip<Real>{{0.6 * limit * 0.999, 0.8 * limit * 0.999}, {}, 0}, 6.66e6));
  EXPECT_TRUE(slips(concrete, Slip<Real>{{0.6 * limit * 1.001, 0.8 * limit * 1.001}, {}, 0}, 6.66e6));
}

TEST(joint_shear, slip_ends_on_the_coulomb_line_in_the_same_direction) {
  Slip<Real> at{{3e-4, -4e-4}, {1e-5, 2e-5}, 0};
  slip_back(concrete, at, 6.66e6);
  EXPECT_NEAR(concrete.stiffness * length(at), 6.66e6, 1e-14 * 6.66e6);
  EXPECT_NEAR(at.elastic[0] / at.elastic[1], -0.75, 1e-14);
}

TEST(joint_shear, slip_moves_the_origin_and_not_the_face) {
  const Slip<Real> before{{3e-4, -4e-4}, {1e-5, 2e-5}, 0};
  Slip<Real> after = before;
  slip_back(concrete, after, 6.66e6);
  for (int axis = 0; axis < 2; ++axis)
    EXPECT_NEAR(after.elastic[axis] + after.memory[axis], before.elastic[axis] + before.memory[axis], 1e-18);
}

TEST(joint_shear, inside_the_strength_nothing_changes) {
  Slip<Real> at{{3e-5, 4e-5}, {1e-5, 2e-5}, 0};
  slip_back(concrete, at, 6.66e6);
  EXPECT_EQ(at.elastic[0], 3e-5);
  EXPECT_EQ(at.memory[1], 2e-5);
  EXPECT_EQ(at.dissipation, 0);
}

TEST(joint_shear, the_work_of_a_slide_is_what_is_stored_and_what_slip_took) {
  // A face dragged along x at constant strength, in small steps: work by the trapezoidal rule, exact for the elastic
  // part; the step in which slip begins leaves an error of the strength times half a step.
  constexpr int steps = 10000;
  constexpr Real far = 1e-3, strength = 6.66e6;
  Slip<Real> at{};
  Real work = 0, slipped = 0, stress = 0;
  for (int step = 0; step < steps; ++step) {
    at.elastic[0] += far / steps;
    at.dissipation = 0;
    slip_back(concrete, at, strength);
    slipped += at.dissipation;
    const Real after = concrete.stiffness * at.elastic[0];
    work += 0.5 * (stress + after) * far / steps;
    stress = after;
  }
  const Real stored = 0.5 * concrete.stiffness * at.elastic[0] * at.elastic[0];
  EXPECT_NEAR(work, stored + slipped, strength * far / steps);
  EXPECT_GT(slipped, 0.9 * work);
}

TEST(joint_shear, no_direction_is_preferred) {
  const Real angle = 0.7, c = std::cos(angle), s = std::sin(angle);
  Slip<Real> plain{{3e-4, -4e-4}, {}, 0}, turned{{c * 3e-4 + s * 4e-4, s * 3e-4 - c * 4e-4}, {}, 0};
  slip_back(concrete, plain, 6.66e6);
  slip_back(concrete, turned, 6.66e6);
  EXPECT_NEAR(turned.elastic[0], c * plain.elastic[0] - s * plain.elastic[1], 1e-18);
  EXPECT_NEAR(turned.elastic[1], s * plain.elastic[0] + c * plain.elastic[1], 1e-18);
  EXPECT_NEAR(turned.dissipation, plain.dissipation, 1e-13 * plain.dissipation);
}

TEST(joint_shear, without_strength_nothing_is_held) {
  Slip<Real> at{{3e-4, -4e-4}, {}, 0};
  slip_back(concrete, at, Real{0});
  EXPECT_EQ(at.elastic[0], 0);
  EXPECT_EQ(at.memory[0], 3e-4);
  EXPECT_EQ(at.dissipation, 0);
  Slip<Real> still{};  // no displacement and no strength: no division by zero
  slip_back(concrete, still, Real{0});
  EXPECT_EQ(still.elastic[0], 0);
}

/// `other` in every lane but one.
Lanes among(Real one, int lane, Real other) {
  Lanes all = broadcast(other);
  all[lane] = one;
  return all;
}

TEST(joint_shear, lanes_give_what_numbers_give_whoever_else_slips) {
  const std::array<Real, 4> x = {3e-4, 1e-5, 0, -2e-4}, y = {-4e-4, 2e-5, 0, 1e-7}, strength = {6.66e6, 6.66e6, 0, 1e6};
  const Lanes xs = {3e-4, 1e-5, 0, -2e-4}, ys = {-4e-4, 2e-5, 0, 1e-7}, strengths = {6.66e6, 6.66e6, 0, 1e6};
  Slip<Lanes> lanes{{xs, ys}, {xs, ys}, {}};
  slip_back(concrete, lanes, strengths);
  for (int lane = 0; lane < 4; ++lane) {
    const auto n = static_cast<std::size_t>(lane);
    const Lanes alone_x = among(x[n], lane, 1e-6), alone_y = among(y[n], lane, 0);
    Slip<Lanes> alone{{alone_x, alone_y}, {alone_x, alone_y}, {}};
    slip_back(concrete, alone, among(strength[n], lane, 6.66e6));
    Slip<Real> number{{x[n], y[n]}, {x[n], y[n]}, 0};
    slip_back(concrete, number, strength[n]);
    for (const auto& [got, same, near] : {std::array{lanes.elastic[0][lane], alone.elastic[0][lane], number.elastic[0]},
                                          std::array{lanes.memory[1][lane], alone.memory[1][lane], number.memory[1]},
                                          std::array{lanes.dissipation[lane], alone.dissipation[lane], number.dissipation}}) {
      EXPECT_EQ(got, same);
      EXPECT_NEAR(got, near, 1e-15 * std::abs(near));  // a root in lanes may be off by the last bit
    }
  }
}

}  // namespace
}  // namespace sazare::laws
