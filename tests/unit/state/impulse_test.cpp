#include "sazare/state/impulse.hpp"

#include <gtest/gtest.h>

namespace sazare::state {
namespace {

TEST(impulse, a_moment_is_the_arm_times_the_force) {
  EXPECT_EQ(moment(Vector3(1, 0, 0), Vector3(0, 2, 0)), Vector3(0, 0, 2));
  EXPECT_EQ(moment(Vector<2>(1, 0), Vector<2>(0, 2))[0], 2);
  EXPECT_EQ(moment(Vector<2>(0, 3), Vector<2>(2, 0))[0], -6);
}

TEST(impulse, a_point_on_an_arm_turns_with_the_body) {
  EXPECT_EQ(turned(Vector3(0, 0, 2), Vector3(1, 0, 0)), Vector3(0, 2, 0));
  EXPECT_EQ(turned(Angular<2>(2.0), Vector<2>(1, 0)), Vector<2>(0, 2));
}

TEST(impulse, power_is_that_of_the_force_at_its_point) {
  const Vector3 arm(0.3, -0.2, 0.5), force(1, 2, -3);
  const MeanMotion<3> motion{{0.1, 0.2, 0.3}, {-1, 0.5, 2}};
  const Wrench<3> wrench{force, moment(arm, force)};
  EXPECT_NEAR(wrench.power(motion), force.dot(motion.velocity + turned(motion.spin, arm)), 1e-15);
}

TEST(impulse, wrenches_add_and_scale) {
  Wrench<2> sum{{1, 2}, Angular<2>(3.0)};
  sum += 2.0 * Wrench<2>{{10, 20}, Angular<2>(30.0)};
  EXPECT_EQ(sum.linear, Vector<2>(21, 42));
  EXPECT_EQ(sum.angular[0], 63);
}

}  // namespace
}  // namespace sazare::state
