#include "sazare/motion/kick.hpp"

#include <gtest/gtest.h>

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
  return kinetic_energy<D>(motion, bodies.inertia[0], bodies.locks[0], motion.velocity, motion.angular_momentum);
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
  const Real work = state::Wrench<3>{given.linear, given.angular}.power(mean);
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
  const Real work = state::Wrench<2>{given.linear, given.angular}.power(mean);
  EXPECT_NEAR(energy(bodies) - before, work, 1e-14);
}

TEST(kick, an_impulse_that_comes_late_counts_from_its_own_moment) {
  // Half a second late: the body is then where it would be had it been given in time.
  auto late = moving_body(), in_time = moving_body();
  const Vector3 linear(1, 2, 4);
  constexpr Real lateness = 0.5;
  state::Impulse<3> given;
  given.linear = linear;
  given.shift = lateness * linear;
  kick<3>(late.motion[0], late.inertia[0], {}, given);
  in_time.motion[0].position += lateness / 2.0 * linear;  // mass 2 kg
  EXPECT_LT((late.motion[0].position - in_time.motion[0].position).norm(), 1e-15);
}

TEST(kick, a_late_pair_of_impulses_keeps_the_angular_momentum) {
  // Impulses at two earlier moments at points of space; the arms are about where the body was drifting then.
  auto bodies = moving_body();
  auto& motion = bodies.motion[0];
  const Real mass = bodies.inertia[0].mass;
  const auto total = [&] { return Vector3(mass * motion.position.cross(motion.velocity) + motion.angular_momentum); };
  Vector3 expected = total();
  state::Impulse<3> given;
  for (const auto& [lateness, linear, point] :
       {std::tuple(0.75, Vector3(1, 2, 4), Vector3(0.7, 2.1, 3.3)), std::tuple(0.25, Vector3(-3, 1, 0.5), Vector3(1.4, 2.2, 2.9))}) {
    const Vector3 centre = motion.position - lateness * motion.velocity;
    given.linear += linear;
    given.shift += lateness * linear;
    given.angular += (point - centre).cross(linear);
    expected += point.cross(linear);
  }
  kick<3>(motion, bodies.inertia[0], {}, given);
  EXPECT_LT((total() - expected).norm(), 1e-14 * expected.norm());
}

TEST(kick, a_late_angular_impulse_turns_the_body_for_the_time_it_was_late) {
  auto bodies = moving_body();
  auto& motion = bodies.motion[0];
  motion.angular_momentum.setZero();
  const Matrix3 before = motion.rotation;
  const Vector3 angular = motion.rotation * Vector3(1e-3, 0, 0);  // about the first principal axis, 1 kg m2
  state::Impulse<3> given;
  given.angular = angular;
  given.twist = 0.5 * angular;
  kick<3>(motion, bodies.inertia[0], {}, given);
  const Matrix3 expected = state::turn(angular, 0.5) * before;
  EXPECT_LT((motion.rotation - expected).norm(), 1e-15);
}

TEST(drift, back_to_an_earlier_moment_is_where_the_body_was_then) {
  auto bodies = moving_body();
  auto& motion = bodies.motion[0];
  drift<3>(motion, bodies.inertia[0], {}, 16, 4.0);
  const Moment now{5, 0.25};
  const auto expected = state::pose_at(motion, now);
  drift_back<3>(motion, bodies.inertia[0], now);
  EXPECT_EQ(motion.due, 5);
  EXPECT_EQ(motion.last_kick, 0);
  EXPECT_LT((motion.position - expected.position).norm(), 1e-15);
  EXPECT_LT((motion.rotation - expected.rotation).norm(), 1e-14);
  EXPECT_LT((bodies.inertia[0].orientation.toRotationMatrix() - motion.rotation).norm(), 1e-14);
}

TEST(drift, there_and_back_is_the_beginning) {
  auto bodies = moving_body();
  auto& motion = bodies.motion[0];
  const auto before = motion;
  drift<3>(motion, bodies.inertia[0], {}, 16, 4.0);
  EXPECT_GT((motion.rotation - before.rotation).norm(), 0.1);
  drift_back<3>(motion, bodies.inertia[0], Moment{0, 0.25});
  EXPECT_LT((motion.position - before.position).norm(), 1e-15);
  EXPECT_LT((motion.rotation - before.rotation).norm(), 1e-14);
}

}  // namespace
}  // namespace sazare::motion
