/// Balls that slide and roll on fine meshes of round surfaces go as they would on the round ones.

#include <gtest/gtest.h>

#include "surfaces.hpp"

namespace sazare::methods::spheres {
namespace {

constexpr Real radius = 0.01, away = 0.04;  // of the ball, and of its centre from that of a hollow [m]
constexpr Real gravity = 9.81;              // [m/s2]
constexpr Real share = 0.4;                 // of the moment of inertia in m r^2

/// A round tube about the axis z in facets of a size.
Wall tube(Real facet) {
  const int around = static_cast<int>(2 * std::numbers::pi * (away + radius) / facet);
  Wall wall;
  const auto node = [&](int i, int j) -> Vector3 {
    const Real angle = 2 * std::numbers::pi * (i % around) / around;
    return {(away + radius) * std::cos(angle), (away + radius) * std::sin(angle), 2.0 * radius * j - radius};
  };
  for (int i = 0; i < around; ++i) {
    wall.triangles.push_back({node(i, 0), node(i + 1, 0), node(i + 1, 1)});
    wall.triangles.push_back({node(i, 0), node(i + 1, 1), node(i, 1)});
  }
  return wall;
}

/// A belt of a hollow sphere, about a polar angle from the lowest point.
Wall belt(Real polar, Real facet) {
  constexpr Real half_width = 0.15 * radius;
  const int around = static_cast<int>(2 * std::numbers::pi * (away + radius) * std::sin(polar) / facet),
            rows = static_cast<int>(half_width / facet) + 1;
  const auto node = [&](int i, int j) -> Vector3 {
    const Real azimuth = 2 * std::numbers::pi * (i % around) / around, angle = polar + facet * j / (away + radius);
    return (away + radius) * Vector3(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), -std::cos(angle));
  };
  Wall wall;
  for (int i = 0; i < around; ++i)
    for (int j = -rows; j < rows; ++j) {
      const Vector3 a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      wall.triangles.push_back({a, b, c});
      wall.triangles.push_back({a, c, d});
    }
  return wall;
}

/// How far a ball is pressed in by a force per mass [m].
Real overlap_at(Real acceleration) {
  const Real modulus = soft.youngs_modulus / (2 * (1 - soft.poisson_ratio * soft.poisson_ratio)),
             mass = 2500 * 4 * std::numbers::pi / 3 * std::pow(radius, 3);
  return std::pow(mass * acceleration / (4.0 / 3 * modulus * std::sqrt(radius)), 2.0 / 3);
}

TEST(curved_surface, a_ball_that_slides_around_a_fine_tube_slows_down_by_coulombs_law_until_it_rolls) {
  // Pressed by its own way around: dv/dt = -mu v^2/a, so v = v0/(1 + mu v0 t/a); its spin takes the rest, and it rolls from 5/7
  // v0 on.
  constexpr Real first = 2, friction = 0.3, step = 5e-6, end_of_slip = 0.4 * away / (friction * first);
  const Wall wall = tube(0.04 * radius);
  auto stepper = make_stepper({{.centre = {away + overlap_at(first * first / away), 0, 0}, .velocity = {0, first, 0}}},
                              {.friction = friction, .step = step}, {wall});
  stepper.start();
  const auto speed_at = [&](Real time) {
    while (stepper.time() < time) stepper.advance();
    stepper.evaluate_now();
    return velocity_of(stepper, 0).norm();
  };
  for (const Real part : {0.25, 0.5, 0.75}) {
    const Real time = part * end_of_slip, slowed = first / (1 + friction * first * time / away);
    EXPECT_NEAR(speed_at(time), slowed, 1e-3 * first) << part;
    EXPECT_NEAR(spin_of(stepper, 0).z(), -(first - slowed) / (share * radius), 2e-3 * first / (share * radius)) << part;
  }
  const Real rolled = speed_at(1.2 * end_of_slip);
  EXPECT_NEAR(rolled, 5.0 / 7 * first, 1e-3 * first);
  const Real period = 2 * std::numbers::pi * away / rolled;
  EXPECT_NEAR(speed_at(1.2 * end_of_slip + 2 * period), rolled, 1e-3 * rolled) << "edges slow it down";
}

TEST(curved_surface, a_ball_rolls_at_one_height_around_a_fine_bowl) {
  // Friction carries 2/7 of the weight along the slope, and turns with the ball. Facets are as large as the zone of contact; what
  // the spring of friction holds is lost when one is left, 0.3 % of the energy in a turn, as by creep between real bodies.
  const Real polar = 60 * degree, rate = std::sqrt(gravity / ((1 + share) * away * std::cos(polar))), step = 1e-5;
  const Vector3 out(std::sin(polar), 0, -std::cos(polar)), velocity(0, away * rate * std::sin(polar), 0);
  const Real pressed = overlap_at(away * std::pow(rate * std::sin(polar), 2) + gravity * std::cos(polar));
  auto stepper = make_stepper({{.centre = (away + pressed) * out, .velocity = velocity, .spin = velocity.cross(out) / radius}},
                              {.friction = 0.6, .step = step, .gravity = {0, 0, -gravity}}, {belt(polar, 0.04 * radius)});
  stepper.start();
  for (int quarter = 1; quarter <= 4; ++quarter) {
    advance(stepper, static_cast<int>(0.5 * std::numbers::pi / (rate * step) + 0.5));
    const Vector3 centre = centre_of(stepper, 0);
    const Real azimuth = std::atan2(centre.y(), centre.x()) - 0.5 * std::numbers::pi * quarter;
    EXPECT_NEAR(std::acos(-centre.z() / centre.norm()), polar, 0.1 * degree) << quarter;
    EXPECT_NEAR(std::remainder(azimuth, 2 * std::numbers::pi), 0, 0.5 * degree) << quarter;
    EXPECT_NEAR(velocity_of(stepper, 0).norm(), velocity.norm(), 3e-3 * velocity.norm()) << quarter;
  }
}

TEST(curved_surface, a_ball_that_rolls_down_a_fine_ridge_is_as_fast_as_on_a_round_one) {
  // Without slip v^2 = 10/7 g (R + r) (cos b - cos a), from b to a.
  const Real facet = 0.02 * radius, angle = 0.004, round = facet / (2 * std::tan(0.5 * angle)), arm = round + radius;
  const Shape fine = trough(-angle, facet);
  const Wall wall = surface([&](int i, int j) -> Vector3 { return fine(i, 100 * j); }, 140);
  const Real first = 0.1;
  auto stepper = make_stepper({{.centre = {arm * std::sin(first), 0.0002, arm * std::cos(first) - round}}},
                              {.restitution = 0.3, .friction = 0.6, .step = 1e-5, .gravity = {0, 0, -gravity}}, {wall});
  stepper.start();
  for (const Real angle_now : {0.2, 0.3, 0.45}) {
    const auto passed = [&] { return centre_of(stepper, 0).x() / arm; };
    while (passed() < std::sin(angle_now) && stepper.time() < 2) stepper.advance();
    stepper.evaluate_now();
    const Real now = std::asin(passed()), speed = std::sqrt(10.0 / 7 * gravity * arm * (std::cos(first) - std::cos(now)));
    EXPECT_NEAR(velocity_of(stepper, 0).norm(), speed, 5e-3 * speed) << angle_now;
    EXPECT_NEAR(spin_of(stepper, 0).y(), speed / radius, 5e-3 * speed / radius) << angle_now;
  }
}

}  // namespace
}  // namespace sazare::methods::spheres
