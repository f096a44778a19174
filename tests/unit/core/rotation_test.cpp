#include "sazare/core/rotation.hpp"

#include <gtest/gtest.h>

namespace sazare {
namespace {

TEST(rotation, a_moment_is_the_arm_times_the_force) {
  EXPECT_EQ(moment(Vector3(1, 0, 0), Vector3(0, 2, 0)), Vector3(0, 0, 2));
  EXPECT_EQ(moment(Vector<2>(1, 0), Vector<2>(0, 2))[0], 2);
  EXPECT_EQ(moment(Vector<2>(0, 3), Vector<2>(2, 0))[0], -6);
}

TEST(rotation, a_point_on_an_arm_turns_with_the_body) {
  EXPECT_EQ(turned(Vector3(0, 0, 2), Vector3(1, 0, 0)), Vector3(0, 2, 0));
  EXPECT_EQ(turned(Angular<2>(2.0), Vector<2>(1, 0)), Vector<2>(0, 2));
}

}  // namespace
}  // namespace sazare
