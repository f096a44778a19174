#include <gtest/gtest.h>

#include "sazare/levels/motion/kick.hpp"

namespace sazare::motion {
namespace {

constexpr state::Locks out_of_plane{0b100, 0b011};  // stays in the plane and turns about z alone

state::Bodies<3> locked_body(state::Locks locks) {
  state::Bodies<3> bodies;
  const Quaternion tilted(Eigen::AngleAxis<Real>(0.9, Vector3(1, -2, 0.5).normalized()));
  state::add_body(bodies, 2.0, Vector3(1, 2, 3), Vector3(1, 2, 2.5), tilted, 1.0);
  bodies.locks[0] = locks;
  return bodies;
}

state::Impulse<3> from_all_sides() {
  state::Impulse<3> given;
  given.linear = {1, 2, 4};
  given.angular = {-1, 0.5, 0.25};
  given.linear_lead = {0.1, 0.1, 0.1};
  given.angular_lead = {0.1, 0.1, 0.1};
  return given;
}

TEST(locks, an_impulse_loses_what_they_take_up) {
  state::Impulse<3> given = from_all_sides();
  clear_locked<3>(given, out_of_plane);
  EXPECT_EQ(given.linear, Vector3(1, 2, 0));
  EXPECT_EQ(given.linear_lead, Vector3(0.1, 0.1, 0));
  EXPECT_EQ(given.angular, Vector3(0, 0, 0.25));
  EXPECT_EQ(given.angular_lead, Vector3(0, 0, 0.1));
}

TEST(locks, a_locked_body_keeps_its_plane_and_axis) {
  auto bodies = locked_body(out_of_plane);
  auto& motion = bodies.motion[0];
  const Vector3 axis = motion.rotation.transpose() * Vector3::UnitZ();  // in the body
  for (int step = 0; step < 50; ++step) {
    kick<3>(motion, bodies.inertia[0], out_of_plane, from_all_sides());
    drift<3>(motion, bodies.inertia[0], out_of_plane, step + 1, 0.02);
    EXPECT_EQ(motion.velocity.z(), 0);
    EXPECT_EQ(motion.spin.x(), 0);
    EXPECT_EQ(motion.spin.y(), 0);
  }
  EXPECT_EQ(motion.position.z(), 3);
  EXPECT_GT(motion.position.x(), 1.1);
  EXPECT_LT((motion.rotation * axis - Vector3::UnitZ()).norm(), 1e-13);
}

TEST(locks, the_free_axis_answers_with_its_own_moment_of_inertia) {
  auto bodies = locked_body(out_of_plane);
  const auto& motion = bodies.motion[0];
  const Matrix3 tensor = motion.rotation * Vector3(1, 2, 2.5).asDiagonal() * motion.rotation.transpose();
  const Vector3 spin = spin_of(motion.rotation, bodies.inertia[0], out_of_plane, {0, 0, 0.7});
  EXPECT_NEAR(spin.z(), 0.7 / tensor(2, 2), 1e-14);
  EXPECT_EQ(spin.head<2>(), Vector<2>(0, 0));
}

TEST(locks, the_impulse_times_the_mean_motion_is_still_the_energy_gained) {
  auto bodies = locked_body(out_of_plane);
  auto& motion = bodies.motion[0];
  const state::Impulse<3> given = from_all_sides();
  const auto mean = kick<3>(motion, bodies.inertia[0], out_of_plane, given);
  const Real gained = kinetic_energy<3>(motion.rotation, bodies.inertia[0], out_of_plane, motion.velocity, motion.angular_momentum);
  EXPECT_NEAR(given.linear.dot(mean.velocity) + given.angular.dot(mean.spin), gained, 1e-14);
}

TEST(locks, all_axes_locked_nothing_moves) {
  constexpr state::Locks all{0b111, 0b111};
  auto bodies = locked_body(all);
  auto& motion = bodies.motion[0];
  const Matrix3 rotation = motion.rotation;
  kick<3>(motion, bodies.inertia[0], all, from_all_sides());
  drift<3>(motion, bodies.inertia[0], all, 1, 0.1);
  EXPECT_EQ(motion.position, Vector3(1, 2, 3));
  EXPECT_LT((motion.rotation - rotation).norm(), 1e-15);
}

TEST(locks, in_the_plane_too) {
  state::Bodies<2> bodies;
  state::add_body(bodies, 2.0, Vector<2>(0, 0), 0.5, 1.0);
  constexpr state::Locks locks{0b01, 0b1};
  auto& motion = bodies.motion[0];
  state::Impulse<2> given;
  given.linear = {4, 6};
  given.angular[0] = 1;
  kick<2>(motion, bodies.inertia[0], locks, given);
  drift<2>(motion, bodies.inertia[0], locks, 1, 1.0);
  EXPECT_EQ(motion.position, Vector<2>(0, 3));
  EXPECT_EQ(bodies.inertia[0].angle, 0);
}

}  // namespace
}  // namespace sazare::motion
