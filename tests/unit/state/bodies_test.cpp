#include "sazare/state/bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sazare::state {
namespace {

TEST(bodies, a_new_body_rests_where_it_was_put) {
  Bodies<3> bodies;
  const Quaternion tilted(Eigen::AngleAxis<Real>(0.4, Vector3(1, 2, 3).normalized()));
  EXPECT_EQ(add_body(bodies, 2.0, {1, 2, 3}, {4, 5, 8}, tilted, 0.7), 0);
  EXPECT_EQ(add_body(bodies, 1.0, {0, 0, 0}, {1, 1, 1}, Quaternion::Identity(), 0.1), 1);
  EXPECT_EQ(bodies.size(), 2);
  EXPECT_EQ(bodies.motion[0].position, Vector3(1, 2, 3));
  EXPECT_TRUE(bodies.motion[0].velocity.isZero(0));
  EXPECT_TRUE(bodies.motion[0].spin.isZero(0));
  EXPECT_EQ(bodies.motion[0].rotation, tilted.toRotationMatrix());
  EXPECT_EQ(bodies.inertia[0].inverse_moments, Vector3(0.25, 0.2, 0.125));
  EXPECT_EQ(bodies.start[0], Vector3(1, 2, 3));
  EXPECT_FALSE(bodies.locks[0].any());
}

TEST(bodies, the_middle_is_that_of_the_box_around_all_centres) {
  Bodies<3> bodies;
  EXPECT_EQ(middle(bodies), Vector3(0, 0, 0));
  for (const Vector3& centre : {Vector3(1, 8, -1), Vector3(3, 2, 0), Vector3(2, 4, 5)})
    add_body(bodies, 1.0, centre, {1, 1, 1}, Quaternion::Identity(), 0.1);
  EXPECT_EQ(middle(bodies), Vector3(2, 5, 2));
}

TEST(bodies, in_the_plane_too) {
  Bodies<2> bodies;
  add_body(bodies, 2.0, Vector<2>(1, 2), 0.5, 0.7);
  EXPECT_EQ(bodies.inertia[0].inverse_moments[0], 2.0);
  EXPECT_EQ(bodies.reach[0], 0.7);
  EXPECT_TRUE(bodies.motion[0].rotation.isIdentity(0));
}

TEST(bodies, a_turn_is_undone_by_the_turn_of_the_opposite_time) {
  const Vector3 spin(0.3, -1.2, 2.0);
  EXPECT_LT((turn(spin, 0.1) * turn(spin, -0.1) - Matrix3::Identity()).norm(), 1e-15);
  EXPECT_LT((turn(spin, 0.1) * turn(spin, 0.1).transpose() - Matrix3::Identity()).norm(), 1e-15);
  EXPECT_TRUE(turn(Vector3(0, 0, 0), 1.0).isIdentity(0));
  const Angular<2> plane(1.3);
  EXPECT_LT((turn(plane, 0.1) * turn(plane, -0.1) - Rotation<2>::Identity()).norm(), 1e-15);
}

TEST(bodies, a_turn_is_by_the_angle_of_the_formula_about_the_spin) {
  const Vector3 spin(0.3, -1.2, 2.0);
  const Real seconds = 0.2, angle = 2 * std::atan(0.5 * spin.norm() * seconds);
  const Matrix3 expected = Eigen::AngleAxis<Real>(angle, spin.normalized()).toRotationMatrix();
  EXPECT_LT((turn(spin, seconds) - expected).norm(), 1e-15);
}

TEST(bodies, the_error_of_a_turn_is_of_third_order) {
  const Vector3 spin(0.3, -1.2, 2.0);
  const auto error = [&](Real seconds) {
    return (turn(spin, seconds) - Eigen::AngleAxis<Real>(spin.norm() * seconds, spin.normalized()).toRotationMatrix()).norm();
  };
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 3, 0.01);
}

TEST(bodies, between_its_times_a_body_is_found_by_drifting_back) {
  Bodies<3> bodies;
  add_body(bodies, 1.0, {1, 2, 3}, {1, 2, 3}, Quaternion::Identity(), 1);
  auto& motion = bodies.motion[0];
  motion.velocity = {1, -1, 0.5};
  motion.spin = {0, 0, 0.2};
  motion.last_kick = 0;
  motion.due = 8;
  const Instant now{2, 0.25};  // 1.5 s before it is due
  const auto pose = pose_at(motion, now);
  EXPECT_LT((pose.position - Vector3(-0.5, 3.5, 2.25)).norm(), 1e-15);
  EXPECT_LT((pose.rotation - turn(motion.spin, -1.5)).norm(), 1e-15);
  EXPECT_EQ(pose_at(motion, Instant{8, 0.25}).position, motion.position);
}

TEST(bodies, several_are_found_where_each_one_is) {
  Bodies<3> bodies;
  for (int body = 0; body < 11; ++body) {  // each with its own time
    add_body(bodies, 1.0, {1.0 * body, 2, 3}, {1, 2, 3}, Quaternion(1, 0.1 * body, 0.2, -0.3).normalized(), 1);
    bodies.motion.back().velocity = {1, -0.5 * body, 0.5};
    bodies.motion.back().spin = {0.1 * body, 0.3, -0.2};
    bodies.motion.back().due = body;
  }
  const Instant now{2, 0.25};
  std::vector<Pose<3>> poses(bodies.motion.size());
  poses_at(bodies.motion, now, poses);
  for (std::size_t body = 0; body < poses.size(); ++body) {
    const auto expected = pose_at(bodies.motion[body], now);
    EXPECT_LT((poses[body].position - expected.position).norm(), 1e-14);
    EXPECT_LT((poses[body].rotation - expected.rotation).norm(), 1e-14);
  }
}

TEST(moments, seconds_come_from_ticks) {
  const Instant now{12, 0.25};
  EXPECT_EQ(now.seconds(), 3.0);
  EXPECT_EQ(now.seconds_since(8), 1.0);
  EXPECT_EQ(now.seconds_since(16), -1.0);
}

}  // namespace
}  // namespace sazare::state
