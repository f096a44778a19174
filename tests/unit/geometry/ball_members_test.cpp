#include "sazare/geometry/ball_members.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sazare::geometry {
namespace {

constexpr Real sphere_volume = 4.18879020478639098462;

/// Balls about their centre of mass along their principal axes, with the properties of their union.
struct Body {
  std::vector<Ball> balls;
  Real volume = 0;
  Vector3 inertia;

  explicit Body(std::vector<Ball> of) : balls(std::move(of)) {
    const UnionProperties whole = properties_of_union(balls);
    const Eigen::SelfAdjointEigenSolver<Matrix3> principal(whole.inertia);
    for (Ball& ball : balls) ball.centre = principal.eigenvectors().transpose() * (ball.centre - whole.centre);
    volume = whole.volume;
    inertia = principal.eigenvalues();
  }
};

void expect_the_whole(const Body& body, const MassShares& shares, Real tolerance) {
  ASSERT_EQ(shares.of.size(), body.balls.size());
  Real volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();
  for (std::size_t n = 0; n < body.balls.size(); ++n) {
    const Vector3& x = body.balls[n].centre;
    EXPECT_GT(shares.of[n].volume, 0) << n;
    EXPECT_GT(shares.of[n].inertia, 0) << n;
    volume += shares.of[n].volume;
    first += shares.of[n].volume * x;
    inertia += shares.of[n].volume * (x.squaredNorm() * Matrix3::Identity() - x * x.transpose()) +
               shares.of[n].inertia * Matrix3::Identity();
  }
  EXPECT_NEAR(volume, body.volume, 1e-12 * body.volume);
  // Centre and inertia of the union are known as far as the lines tell.
  EXPECT_LT(first.norm(), 2e-6 * body.volume * body.balls.front().radius);
  const Real error = (inertia - Matrix3(body.inertia.asDiagonal())).norm() / body.inertia.norm();
  EXPECT_LT(error, tolerance);
  EXPECT_NEAR(error, shares.error, 1e-12);
}

/// A plane across the middle cuts two equal balls; each has its half of the union.
TEST(ball_members, cells_of_two_balls_are_halves_of_their_union) {
  const std::vector<Ball> balls{{{0, 0, 0}, 0.5}, {{0, 0.36, 0.48}, 0.5}};
  const std::vector<Real> cells = cell_volumes(balls);
  const Real r = 0.5, d = 0.6;
  const Real whole = 2 * sphere_volume * r * r * r - std::numbers::pi * (4 * r + d) * (2 * r - d) * (2 * r - d) / 12;
  EXPECT_NEAR(cells[0], 0.5 * whole, 2e-4 * whole);
  EXPECT_NEAR(cells[1], 0.5 * whole, 2e-4 * whole);
}

TEST(ball_members, cells_fill_the_union_once) {
  std::vector<Ball> balls = tetrapod_balls(2, 4);
  balls.push_back({{0.05, 0, 0}, 0.1});  // hidden
  balls.push_back(balls.front());        // twice
  const std::vector<Real> cells = cell_volumes(balls);
  const Real whole = properties_of_union(balls).volume;
  EXPECT_NEAR(std::accumulate(cells.begin(), cells.end(), 0.0), whole, 1e-3 * whole);
  EXPECT_EQ(cells[cells.size() - 2], 0);
  EXPECT_EQ(cells.back(), 0);
}

TEST(ball_members, a_tetrapod_keeps_mass_centre_and_inertia) {
  for (const int per_leg : {1, 2, 3, 4, 8}) {
    const Body body(tetrapod_balls(0.08, per_leg));
    expect_the_whole(body, share_mass(body.balls, body.volume, body.inertia), 1e-5);
  }
}

TEST(ball_members, a_bar_keeps_mass_centre_and_inertia) {
  for (const int count : {3, 5, 9}) {
    std::vector<Ball> balls;
    for (int n = 0; n < count; ++n) balls.push_back({{0.3 * n, 0.4 * n, 0}, 0.35});
    const Body body(std::move(balls));
    expect_the_whole(body, share_mass(body.balls, body.volume, body.inertia), 3e-4);  // across the bar by the lines alone
  }
}

/// No two of its inertias are alike, and it has no centre of symmetry.
TEST(ball_members, an_uneven_body_keeps_mass_centre_and_inertia) {
  std::vector<Ball> balls;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 2; ++k) balls.push_back({{0.8 * i, 0.9 * j + 0.1 * k * i, 0.7 * k}, 0.55 + 0.03 * i});
  const Body body(std::move(balls));
  expect_the_whole(body, share_mass(body.balls, body.volume, body.inertia), 1e-8);
}

/// Two balls have mass and centre; about the axis across them they cannot have the inertia of a thick bar.
TEST(ball_members, two_balls_say_what_they_lack) {
  const Body body({{{0, 0, 0}, 0.5}, {{0.4, 0, 0}, 0.45}});
  const MassShares shares = share_mass(body.balls, body.volume, body.inertia);
  expect_the_whole(body, shares, 0.2);
  EXPECT_GT(shares.error, 1e-3);
}

TEST(ball_members, neighbours_are_those_with_none_between) {
  std::vector<Ball> row;
  for (int n = 0; n < 6; ++n) row.push_back({{0.3 * n, 0, 0}, 1});
  const auto along = neighbouring_balls(row, 0.01);
  ASSERT_EQ(along.size(), 5);
  for (std::size_t n = 0; n < 5; ++n) EXPECT_EQ(along[n], (std::pair{static_cast<Index>(n), static_cast<Index>(n + 1)}));
  const auto tetrapod = tetrapod_balls(1, 4);
  const auto legs = neighbouring_balls(tetrapod, 0.01);
  EXPECT_EQ(legs.size(), 16);  // along the legs, and none from leg to leg
  EXPECT_TRUE(hang_together(tetrapod.size(), legs));
}

TEST(ball_members, a_lattice_has_no_diagonals) {
  std::vector<Ball> cube;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) cube.push_back({{1.0 * i, 1.0 * j, 1.0 * k}, 0.8});
  EXPECT_EQ(neighbouring_balls(cube, 0).size(), 54);
}

TEST(ball_members, balls_that_do_not_touch_do_not_hang_together) {
  const std::vector<Ball> balls{{{0, 0, 0}, 0.5}, {{1.005, 0, 0}, 0.5}, {{2.05, 0, 0}, 0.5}};
  EXPECT_EQ(neighbouring_balls(balls, 0.01).size(), 1);
  EXPECT_FALSE(hang_together(3, neighbouring_balls(balls, 0.01)));
  EXPECT_TRUE(hang_together(3, neighbouring_balls(balls, 0.05)));
}

}  // namespace
}  // namespace sazare::geometry
