/// Friction passes from facet to facet where a ball rolls over an edge.

#include <gtest/gtest.h>

#include "surfaces.hpp"

namespace sazare::methods::spheres {
namespace {

constexpr Real radius = 0.01, gravity = 9.81, tilt = 20 * degree,
               mass = 2500 * 4 * std::numbers::pi / 3 * radius * radius * radius;

/// Two facets that are apart by an angle along x = 0, concave or convex.
Wall crease(Real angle) {
  constexpr Real facet = 0.05;
  return surface(
      [=](int i, int j) -> Vector3 {
        const Real x = facet * i;
        return i < 0 ? Vector3(x, facet * j, 0) : Vector3(x * std::cos(angle), facet * j, x * std::sin(angle));
      },
      2);
}

struct Range {
  Real least = 1, most = 1;
};

/// Friction over what a ball needs to roll down without slip, 2/7 of its weight along the slope, while it passes the edge at a
/// distance from its nearest end.
Range friction_over_edge(Real angle, Real from_end, laws::ContactModel model) {
  const Real modulus = soft.youngs_modulus / (2 * (1 - soft.poisson_ratio * soft.poisson_ratio)),
             pressed = std::pow(mass * gravity * std::cos(tilt) / (4.0 / 3 * modulus * std::sqrt(radius)), 2.0 / 3), speed = 0.1;
  auto stepper =
      make_stepper({{.centre = {-0.004, from_end, radius - pressed}, .velocity = {speed, 0, 0}, .spin = {0, speed / radius, 0}}},
                   {.restitution = 0.3,
                    .friction = 0.6,
                    .step = 4e-6,
                    .gravity = gravity * Vector3(std::sin(tilt), 0, -std::cos(tilt)),
                    .model = model},
                   {crease(angle)});
  stepper.start();
  const Real needed = 2.0 / 7 * mass * gravity * std::sin(tilt);
  Range range;
  while (centre_of(stepper, 0).x() < 0.001) {
    advance(stepper, 5);
    if (centre_of(stepper, 0).x() < -0.001) continue;
    const Real share = stepper.load(0).my / (radius * needed);
    range = {std::min(range.least, share), std::max(range.most, share)};
  }
  return range;
}

TEST(edge_friction, holds_a_rolling_ball_over_shallow_edges) {
  for (const auto model : {laws::ContactModel::hertz, laws::ContactModel::mindlin_deresiewicz})
    for (const Real angle : {0.05, 0.2, -0.2})
      for (const Real from_end : {0.013, 1e-5}) {
        const Range range = friction_over_edge(angle * degree, from_end, model);
        EXPECT_GT(range.least, 0.95) << angle << " degrees, " << from_end << " m";
        EXPECT_LT(range.most, 1.05) << angle << " degrees, " << from_end << " m";
      }
}

}  // namespace
}  // namespace sazare::methods::spheres
