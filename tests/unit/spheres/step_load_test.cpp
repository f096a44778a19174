/// How much of a stable step contacts take: against exact limits, and against steps that are too long.

#include "sazare/methods/spheres/step_load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene.hpp"

namespace sazare::methods::spheres {
namespace {

constexpr Real radius = 0.01, pressed = 1e-4;
const Real mass = 2500 * 4 * std::numbers::pi / 3 * std::pow(radius, 3);

Wall plane(const Vector3& point, const Vector3& normal) {
  Wall wall;
  wall.point = point;
  wall.normal = normal;
  return wall;
}

/// A sphere that is pressed by two planes.
SphereStepper squeezed(const Rules& rules, Real speed = 0) {
  return make_stepper({{.centre = {0, 0, radius - pressed}, .velocity = {0, 0, speed}}}, rules,
                      {plane(Vector3::Zero(), Vector3::UnitZ()), plane({0, 0, 2 * (radius - pressed)}, -Vector3::UnitZ())});
}

Real load_of(SphereStepper stepper) {
  stepper.start();
  stepper.look_at_step();
  return stepper.step_load().load;
}

TEST(step_load, of_a_sphere_between_planes_is_that_of_two_springs) {
  const Real step = 1e-6, hertz = 1.5 * 4 / 3.0 * 1e8 / (2 * 0.91) * std::sqrt(radius * pressed);
  EXPECT_NEAR(load_of(squeezed({.step = step})), step * step * 2 * hertz / mass / 4, 1e-12);
  EXPECT_NEAR(load_of(squeezed({.step = step, .model = laws::ContactModel::linear})), step * step * 2e5 / mass / 4, 1e-12);
}

TEST(step_load, of_two_spheres_is_that_of_their_motion_against_each_other) {
  const Real step = 1e-6;
  auto stepper = make_stepper({{.centre = {0, 0, 0}}, {.centre = {2 * radius - pressed, 0, 0}}},
                              {.step = step, .model = laws::ContactModel::linear});
  EXPECT_NEAR(load_of(std::move(stepper)), step * step * 2e5 / mass / 4, 1e-12);
}

/// Friction lets a sphere on a plane turn and slide at once: w^2 = k_t (1/m + r^2/I).
TEST(step_load, counts_what_friction_does_to_spins) {
  const Real step = 1e-6, arm = radius - 0.5 * pressed;
  auto stepper = make_stepper({{.centre = {0, 0, radius - pressed}}},
                              {.friction = 0.5, .step = step, .model = laws::ContactModel::linear}, {Wall{}});
  EXPECT_NEAR(load_of(std::move(stepper)), step * step * 8e4 * (1 / mass + arm * arm / (0.4 * mass * radius * radius)) / 4, 1e-12);
}

/// Just below a load of 1 a sphere keeps its energy, just above it blows up.
TEST(step_load, of_one_is_where_a_step_becomes_unstable) {
  const Real longest = 2 / std::sqrt(2e5 / mass);
  for (const Real share : {0.98, 1.02}) {
    auto stepper = squeezed({.step = share * longest, .model = laws::ContactModel::linear}, 1e-7);
    stepper.start();
    stepper.look_at_step();
    EXPECT_EQ(stepper.step_load().load < 1, share < 1);
    EXPECT_EQ(stepper.step_load().sphere, 0);
    advance(stepper, 200);
    EXPECT_EQ(velocity_of(stepper, 0).norm() < 1e-5, share < 1) << velocity_of(stepper, 0).norm();
  }
}

/// A dashpot of its own limit: c h/m = 1 without a spring, and with one w^2 h^2 + 4 c h/m = 4.
TEST(step_load, counts_dashpots) {
  const Real step = 1e-6, share = laws::damping_share(0.5), damping = 2 * share * std::sqrt(1e5 * mass);
  ASSERT_LT(damping, laws::most_normal_damping * mass / step);
  EXPECT_NEAR(load_of(squeezed({.restitution = 0.5, .step = step, .model = laws::ContactModel::linear})),
              2 * (step * step * 1e5 + 4 * step * damping) / mass / 4, 1e-12);
}

/// Among others a sphere bears less than Rayleigh's time says.
TEST(step_load, grows_with_the_spheres_that_touch) {
  const Real step = 1e-6;
  std::vector<Grain> grains{{.centre = {0, 0, 0}}};
  Real before = 0;
  for (const Vector3& side : {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 1, 0), Vector3(0, -1, 0)}) {  // all resist a spin about z
    grains.push_back({.centre = (2 * radius - pressed) * side});
    const Real load = load_of(make_stepper(grains, {.friction = 0.5, .step = step}));
    EXPECT_GT(load, before * (1 + 1e-9));
    before = load;
  }
}

}  // namespace
}  // namespace sazare::methods::spheres
