#include "sazare/geometry/ball_union.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cube.hpp"

namespace sazare::geometry {
namespace {

constexpr Real sphere_volume = 4.18879020478639098462;

TEST(ball_union, one_ball_has_the_properties_of_a_sphere) {
  const Vector3 centre(0.3, -0.2, 0.1);
  const std::vector<Ball> balls{{centre, 0.5}};
  const UnionProperties of = properties_of_union(balls);
  const Real volume = sphere_volume * 0.125;
  EXPECT_NEAR(of.volume, volume, 1e-4 * volume);
  EXPECT_LT((of.centre - centre).norm(), 1e-6);
  EXPECT_LT((of.inertia - 0.4 * volume * 0.25 * Matrix3::Identity()).norm(), 2e-4 * of.inertia.norm());
  EXPECT_LT(of.error, 5e-4);
  EXPECT_GT(of.error, 0);
}

TEST(ball_union, what_balls_share_counts_once) {
  const std::vector<Ball> balls{{{0, 0, 0}, 0.5}, {{0, 0, 0}, 0.5}, {{0.1, 0, 0}, 0.2}};
  EXPECT_NEAR(properties_of_union(balls).volume, sphere_volume * 0.125, 1e-4 * sphere_volume * 0.125);
}

/// Two balls of radius r whose centres are d apart share a lens of pi (4 r + d) (2 r - d)^2/12.
TEST(ball_union, two_balls_that_overlap_lack_their_lens) {
  const Real r = 0.5, d = 0.6;
  for (const Vector3& along : {Vector3(1, 0, 0), Vector3(0, 0, 1), Vector3(0.6, 0, 0.8)}) {
    const std::vector<Ball> balls{{Vector3::Zero(), r}, {d * along, r}};
    const UnionProperties of = properties_of_union(balls);
    const Real volume = 2 * sphere_volume * r * r * r - std::numbers::pi * (4 * r + d) * (2 * r - d) * (2 * r - d) / 12;
    EXPECT_NEAR(of.volume, volume, 2e-4 * volume);
    EXPECT_LT((of.centre - 0.5 * d * along).norm(), 1e-4);
    // The axis through both is the one of the least inertia.
    const Vector3 turned = of.inertia * along;
    EXPECT_LT((turned - along.dot(turned) * along).norm(), 1e-3 * turned.norm());
    EXPECT_LT(along.dot(turned), of.inertia.trace() / 3);
  }
}

TEST(ball_union, a_tetrapod_has_four_equal_legs) {
  const std::vector<Ball> balls = tetrapod_balls(2, 5);
  ASSERT_EQ(balls.size(), 21);
  const UnionProperties of = properties_of_union(balls);
  EXPECT_LT(of.centre.norm(), 1e-3);
  EXPECT_LT((of.inertia - of.inertia.trace() / 3 * Matrix3::Identity()).norm(), 1e-3 * of.inertia.norm());
  // The balls fill what lies along the axes; the corners of the ends and the seams between legs are left out.
  EXPECT_GT(of.volume, 0.85 * 0.280 * 8);
  EXPECT_LT(of.volume, 0.280 * 8);
  Real lowest = 0, highest = 0;
  for (const Ball& ball : balls) {
    lowest = std::min(lowest, ball.centre.z() - ball.radius);
    highest = std::max(highest, ball.centre.z() + ball.radius);
  }
  EXPECT_NEAR(highest, 0.644 * 2, 1e-9);
  EXPECT_LT(highest - lowest, 2);
  EXPECT_GT(highest - lowest, 1.9);
}

TEST(ball_union, balls_fill_a_cube_from_within) {
  const auto surface = cube(1);
  const std::vector<Ball> balls = fill_with_balls(surface, 60, 24);
  ASSERT_EQ(balls.size(), 60);
  EXPECT_NEAR(balls.front().radius, 0.5, 0.03);
  for (const Ball& ball : balls)
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(ball.centre[axis] - ball.radius, -1e-9);
      EXPECT_LE(ball.centre[axis] + ball.radius, 1 + 1e-9);
    }
  EXPECT_GT(properties_of_union(balls, 128).volume, 0.75);
}

}  // namespace
}  // namespace sazare::geometry
