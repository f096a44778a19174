#include <gtest/gtest.h>

#include "sazare/levels/motion/kick.hpp"

namespace sazare::motion {
namespace {

state::Bodies<3> moving_body() {
  state::Bodies<3> bodies;
  const Quaternion tilted(Eigen::AngleAxis<Real>(0.9, Vector3(1, -2, 0.5).normalized()));
  state::add_body(bodies, 2.0, Vector3(1, 2, 3), Vector3(1, 2, 2.5), tilted, 1.0);
  bodies.motion[0].velocity = {0.3, -0.1, 0.2};
  bodies.motion[0].angular_momentum = {0.4, 1.0, -0.6};
  return bodies;
}

template <int D>
Real energy(const state::Bodies<D>& bodies) {
  const auto& motion = bodies.motion[0];
  return kinetic_energy<D>(motion.rotation, bodies.inertia[0], bodies.locks[0], motion.velocity, motion.angular_momentum);
}

TEST(kick, changes_the_momenta_by_the_impulse) {
  auto bodies = moving_body();
  const auto before = bodies.motion[0];
  state::Impulse<3> given;
  given.linear = {1, 2, 4};
  given.angular = {-1, 0.5, 0.25};
  kick<3>(bodies.motion[0], bodies.inertia[0], {}, given);
  const auto& after = bodies.motion[0];
  EXPECT_LT((after.velocity - before.velocity - Vector3(0.5, 1, 2)).norm(), 1e-15);
  EXPECT_LT((after.angular_momentum - before.angular_momentum - given.angular).norm(), 1e-15);
  EXPECT_EQ(after.position, before.position);
  EXPECT_EQ(after.rotation, before.rotation);
}

TEST(kick, the_impulse_times_the_mean_motion_is_the_energy_gained) {
  auto bodies = moving_body();
  const Real before = energy(bodies);
  state::Impulse<3> given;
  given.linear = {1, 2, 4};
  given.angular = {-1, 0.5, 0.25};
  const auto mean = kick<3>(bodies.motion[0], bodies.inertia[0], {}, given);
  const Real work = given.linear.dot(mean.velocity) + given.angular.dot(mean.spin);
  EXPECT_NEAR(energy(bodies) - before, work, 1e-14 * work);
}

TEST(kick, in_the_plane_too) {
  state::Bodies<2> bodies;
  state::add_body(bodies, 2.0, Vector<2>(0, 0), 0.5, 1.0);
  bodies.motion[0].velocity = {1, 0};
  bodies.motion[0].angular_momentum[0] = 0.25;
  const Real before = energy(bodies);
  state::Impulse<2> given;
  given.linear = {1, -2};
  given.angular[0] = 0.5;
  const auto mean = kick<2>(bodies.motion[0], bodies.inertia[0], {}, given);
  EXPECT_EQ(bodies.motion[0].velocity, Vector<2>(1.5, -1));
  EXPECT_EQ(bodies.motion[0].angular_momentum[0], 0.75);
  const Real work = given.linear.dot(mean.velocity) + given.angular.dot(mean.spin);
  EXPECT_NEAR(energy(bodies) - before, work, 1e-14);
}

TEST(predict, the_velocity_follows_what_the_momentum_gains) {
  auto bodies = moving_body();
  auto& motion = bodies.motion[0];
  state::Impulse<3> given;
  given.linear_lead = {1, 2, 4};
  predict<3>(motion, bodies.inertia[0], {}, given);
  EXPECT_LT((motion.predicted_velocity - (motion.velocity + Vector3(0.5, 1, 2))).norm(), 1e-15);  // mass 2 kg
}

TEST(predict, the_spin_follows_likewise) {
  auto bodies = moving_body();
  auto& motion = bodies.motion[0];
  const Vector3 spin = spin_of(motion.rotation, bodies.inertia[0], {}, motion.angular_momentum);
  const Vector3 torque = motion.rotation * Vector3(0, 4, 0);  // about the second principal axis, 2 kg m2
  state::Impulse<3> given;
  given.angular_lead = 0.3 * torque;
  predict<3>(motion, bodies.inertia[0], {}, given);
  EXPECT_LT((motion.predicted_spin - (spin + 0.3 * 0.5 * torque)).norm(), 1e-15);
}

TEST(predict, nothing_changes_along_locked_axes) {
  auto bodies = moving_body();
  state::Impulse<3> given;
  given.linear_lead = {1, 2, 4};
  predict<3>(bodies.motion[0], bodies.inertia[0], {0b100, 0}, given);
  EXPECT_EQ(bodies.motion[0].predicted_velocity.z(), bodies.motion[0].velocity.z());
  EXPECT_GT(bodies.motion[0].predicted_velocity.x(), bodies.motion[0].velocity.x());
}

TEST(drift, back_to_an_earlier_moment_is_where_the_body_was_then) {
  auto bodies = moving_body();
  auto& motion = bodies.motion[0];
  drift<3>(motion, bodies.inertia[0], {}, 16, 4.0);
  const Instant now{5, 0.25};
  const auto expected = state::pose_at(motion, now);
  drift_back<3>(motion, bodies.inertia[0], now);
  EXPECT_EQ(motion.due, 5);
  EXPECT_EQ(motion.last_kick, 0);
  EXPECT_LT((motion.position - expected.position).norm(), 1e-15);
  EXPECT_LT((motion.rotation - expected.rotation).norm(), 1e-14);
  EXPECT_LT((bodies.inertia[0].orientation.toRotationMatrix() - motion.rotation).norm(), 1e-14);
}

TEST(drift, back_takes_what_is_predicted_along) {
  auto bodies = moving_body();
  auto& motion = bodies.motion[0];
  drift<3>(motion, bodies.inertia[0], {}, 16, 4.0);
  motion.predicted_velocity = motion.velocity + Vector3(1, 0, 0);  // at tick 16; at tick 8 the mean is reached
  motion.predicted_spin = motion.spin + Vector3(0, 2, 0);
  drift_back<3>(motion, bodies.inertia[0], Instant{12, 0.25});
  EXPECT_LT((motion.predicted_velocity - motion.velocity - Vector3(0.5, 0, 0)).norm(), 1e-15);
  EXPECT_LT((motion.predicted_spin - motion.spin - Vector3(0, 1, 0)).norm(), 1e-15);
}

TEST(drift, there_and_back_is_the_beginning) {
  auto bodies = moving_body();
  auto& motion = bodies.motion[0];
  const auto before = motion;
  drift<3>(motion, bodies.inertia[0], {}, 16, 4.0);
  EXPECT_GT((motion.rotation - before.rotation).norm(), 0.1);
  drift_back<3>(motion, bodies.inertia[0], Instant{0, 0.25});
  EXPECT_LT((motion.position - before.position).norm(), 1e-15);
  EXPECT_LT((motion.rotation - before.rotation).norm(), 1e-14);
}

}  // namespace
}  // namespace sazare::motion
