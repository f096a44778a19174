#include <gtest/gtest.h>

#include "tests/support/bonded_pair.hpp"

namespace sazare::methods::blocks {
namespace {

using sazare::test::BondedPair;

constexpr Real elastic_opening = 6.66e6 / 450e9, failure_opening = 2 * 99.67 / 6.66e6;

void tilt(state::Motion<3>& motion, const Vector3& axis, Real angle) {
  motion.rotation = Eigen::AngleAxis<Real>(angle, axis.normalized()).toRotationMatrix() * motion.rotation;
}

/// Both blocks moved and turned by a little, well within the elastic range (1.5e-5 m across, 7e-5 m along).
void disturb(BondedPair& pair) {
  pair.place(2e-6, 3e-6, -4e-6);
  pair.bodies().motion[0].position += Vector3(1e-6, -2e-6, 1e-6);
  tilt(pair.bodies().motion[0], {1, 2, 3}, 3e-5);
  tilt(pair.bodies().motion[1], {-2, 1, 0.5}, 4e-5);
}

void expect_forces_from_energy(BondedPair& pair) {
  const auto forces = pair.forces();
  const Real size = forces[1].linear.norm();
  ASSERT_GT(size, 1000);
  for (Index body = 0; body < 2; ++body)
    for (int freedom = 0; freedom < 6; ++freedom) {
      const Real step = freedom < 3 ? 1e-8 : 1e-7;  // energies of 0.01 J: rounding of 1e-9 N, truncation below that
      EXPECT_NEAR(sazare::test::component(forces[static_cast<std::size_t>(body)], freedom),
                  sazare::test::energy_slope(pair.probe(), pair.bodies(), body, freedom, step), 1e-7 * size)
          << body << " " << freedom;
    }
}

TEST(joint_force, is_the_slope_of_the_energy_for_every_freedom_of_both_blocks) {
  BondedPair pair;
  disturb(pair);
  expect_forces_from_energy(pair);
}

TEST(joint_force, is_the_slope_of_the_energy_for_a_softened_joint_too) {
  BondedPair pair;
  pair.place(0.6 * failure_opening);
  pair.forces();
  disturb(pair);
  EXPECT_EQ(pair.joints().state(0), JointState::softening);
  expect_forces_from_energy(pair);
}

TEST(joint_force, is_the_slope_of_the_energy_after_slip_too) {
  BondedPair pair;
  pair.place(-1e-6, 2e-4, 1e-4);
  pair.forces();
  pair.place(-1e-6, 1.8e-4, 1e-4);  // back within the Coulomb line
  tilt(pair.bodies().motion[1], {-2, 1, 0.5}, 1e-5);
  expect_forces_from_energy(pair);
}

TEST(joint_force, action_and_reaction_leave_no_force_and_no_moment) {
  BondedPair pair;
  disturb(pair);
  pair.bodies().motion[0].velocity = {1, -2, 0.5};
  pair.bodies().motion[1].spin = {10, 20, -30};
  const auto forces = pair.forces();
  const Real size = forces[0].linear.norm();
  EXPECT_LT((forces[0].linear + forces[1].linear).norm(), 1e-15 * size);
  Vector3 moments = forces[0].angular + forces[1].angular;
  for (std::size_t body = 0; body < 2; ++body) moments += moment(pair.bodies().motion[body].position, forces[body].linear);
  EXPECT_LT(moments.norm(), 1e-14 * size * 0.1);
}

TEST(joint_force, the_area_is_that_of_the_face_to_single_precision) {
  const Real area = 0.1 * 0.1 * std::sqrt(3.0) / 4;
  EXPECT_NEAR(BondedPair().area(), area, 6e-8 * area);
}

/// Each body's dashpots against those of three points of the face, where it lies as it did at first.
TEST(joint_force, dashpots_are_those_of_the_three_vertices) {
  BondedPair pair;
  auto& motions = pair.bodies().motion;
  motions[0].velocity = {0.1, -0.2, 0.3};
  motions[0].spin = {3, -1, 2};
  motions[1].velocity = {-0.3, 0.1, 0.2};
  motions[1].spin = {1, 2, -5};
  const auto mesh = sazare::test::two_blocks();
  Vector3 force = Vector3::Zero(), moments = Vector3::Zero();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vector3& point = mesh.nodes[corner];
    const Vector3 arm = point - motions[1].position;
    const auto speed_of = [&](const auto& body) { return Vector3(body.velocity + body.spin.cross(point - body.position)); };
    const Vector3 speed = speed_of(motions[1]) - speed_of(motions[0]);
    const Vector3 at_point = -pair.area() / 3 * Vector3(22.6e6 * speed.x(), 10.1e6 * speed.y(), 10.1e6 * speed.z());
    force += at_point;
    moments += moment(arm, at_point);
  }
  const auto on_second = pair.forces()[1];
  EXPECT_LT((on_second.linear - force).norm(), 1e-7 * force.norm());
  EXPECT_LT((on_second.angular - moments).norm(), 1e-7 * moments.norm());
}

TEST(joint_force, nothing_at_rest_and_nothing_by_moving_all_together) {
  BondedPair pair;
  EXPECT_LT(pair.forces()[1].linear.norm(), 1e-6);
  const Matrix3 turn = Eigen::AngleAxis<Real>(0.7, Vector3(1, 1, 2).normalized()).toRotationMatrix();
  for (auto& motion : pair.bodies().motion) {
    motion.position = Vector3(5, -3, 1) + turn * motion.position;
    motion.rotation = turn * motion.rotation;
  }
  // Positions of some metres are known to 1e-15 m: 4.5e11 Pa/m x 4e-3 m2 x 1e-15 m = 2e-6 N and a few of these.
  EXPECT_LT(pair.forces()[1].linear.norm(), 2e-5);
}

TEST(joint_force, stiffness_is_per_area_across_and_along_the_face) {
  BondedPair pair;
  pair.place(5e-6, 2e-6, -1e-6);
  const Vector3 stress = pair.stress();
  EXPECT_NEAR(stress.x(), 450e9 * 5e-6, 1);
  EXPECT_NEAR(stress.y(), 90e9 * 2e-6, 1);
  EXPECT_NEAR(stress.z(), 90e9 * -1e-6, 1);
}

TEST(joint_force, dashpots_are_per_area_across_and_along_the_face) {
  BondedPair pair;
  pair.bodies().motion[1].velocity = {0.01, 0.02, -0.03};
  pair.bodies().motion[0].velocity = {-0.01, 0, 0};
  const Vector3 stress = pair.stress();
  EXPECT_NEAR(stress.x(), 22.6e6 * 0.02, 1e-3);
  EXPECT_NEAR(stress.y(), 10.1e6 * 0.02, 1e-3);
  EXPECT_NEAR(stress.z(), 10.1e6 * -0.03, 1e-3);
}

TEST(joint_force, shear_stays_on_the_coulomb_line_under_any_normal_stress) {
  for (const Real n : {-2e-5, -5e-6, 0.0, 5e-6, 1.4e-5}) {
    BondedPair pair;
    pair.place(n, 1.5e-4, -2e-4);  // far beyond 7.4e-5 m
    const Vector3 stress = pair.stress();
    const Real strength = std::max(0.0, 6.66e6 - 0.58 * 450e9 * n);
    EXPECT_NEAR(stress.tail<2>().norm(), strength, 1e-9 * 6.66e6) << n;
    EXPECT_NEAR(stress.y() / stress.z(), -0.75, 1e-6) << n;
  }
}

TEST(joint_force, slip_is_dissipated_at_the_strength) {
  BondedPair pair;
  const Real limit = 6.66e6 / 90e9;
  Real work = 0, before = 0;
  constexpr int steps = 400;
  for (int step = 1; step <= steps; ++step) {
    pair.place(0, 5 * limit * step / steps);
    const Real force = pair.stress().y() * pair.area();
    work += 0.5 * (before + force) * 5 * limit / steps;
    before = force;
  }
  const auto balance = pair.probe().energy_balance();
  const Real slip = balance[terms::EnergyKind::slip], elastic = balance[terms::EnergyKind::elastic];
  EXPECT_NEAR(slip, 6.66e6 * 4 * limit * pair.area(), 1e-11 * slip);
  EXPECT_NEAR(work, slip + elastic, 1e-3 * work);  // trapezoidal rule over the corner at the limit
  EXPECT_NEAR(balance[terms::EnergyKind::fracture], 0, 0);
}

TEST(joint_force, a_joint_of_other_strength_obeys_its_own) {
  auto weak = sazare::test::concrete_joint("left", "right");
  weak.cohesion = 1e6;
  weak.friction_coefficient = 0;
  BondedPair pair(weak);
  pair.place(-1e-5, 1e-4);
  EXPECT_NEAR(pair.stress().y(), 1e6, 1e-3);
  EXPECT_LT(elastic_opening, failure_opening);
}

}  // namespace
}  // namespace sazare::methods::blocks
