/// Motion of spheres against exact answers, and what must be kept.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene.hpp"

namespace sazare::methods::spheres {
namespace {

TEST(sphere_stepper, free_fall_is_exact) {
  auto stepper = make_stepper({{.centre = {0, 0, 1}, .velocity = {1, 0, 2}}}, {.step = 1e-3, .gravity = {0, 0, -10}});
  stepper.start();
  advance(stepper, 500);
  EXPECT_NEAR(centre_of(stepper, 0).x(), 0.5, 1e-13);
  EXPECT_NEAR(centre_of(stepper, 0).z(), 1 + 2 * 0.5 - 5 * 0.25, 1e-13);
  EXPECT_NEAR(velocity_of(stepper, 0).z(), -3, 1e-13);
  EXPECT_NEAR(stepper.energies().sum(), 0.5 * 2500 * 4.18879020478639e-6 * 5 + 10 * 2500 * 4.18879020478639e-6, 1e-14);
}

/// Hertz: two equal spheres, closing speed v; t = 2.8683 (m^2/(R E^2 v))^(1/5), d = (15 m v^2/(16 E sqrt R))^(2/5) with reduced
/// m, R, E.
TEST(sphere_stepper, contact_lasts_as_hertz_says) {
  const Real speed = 2, step = 1e-7;
  auto stepper = make_stepper({{.centre = {-0.0100001, 0, 0}, .velocity = {speed / 2, 0, 0}},
                               {.centre = {0.0100001, 0, 0}, .velocity = {-speed / 2, 0, 0}}},
                              {.step = step});
  stepper.start();
  const Real mass = 0.5 * stepper.spheres().place[0].mass, radius = 0.005, modulus = 1e8 / (2 * (1 - 0.09));
  int touching = 0;
  Real deepest = 0;
  for (int k = 0; k < 20000; ++k) {
    advance(stepper, 1);
    touching += stepper.contacts() > 0 ? 1 : 0;
    deepest = std::max(deepest, 0.02 - (centre_of(stepper, 1) - centre_of(stepper, 0)).norm());
  }
  const Real shape = 1.25 * mass * speed * speed / (4.0 / 3 * modulus * std::sqrt(radius));
  EXPECT_NEAR(deepest, std::pow(shape, 0.4), 1e-5 * deepest);
  EXPECT_NEAR(touching * step, 2.9432751 * std::pow(shape, 0.4) / speed, 2 * step);
  EXPECT_NEAR(velocity_of(stepper, 0).x(), -speed / 2, 1e-7);
}

/// A ball that slides on a floor ends rolling at 5/7 of its speed, after 2 v/(7 mu g).
TEST(sphere_stepper, sliding_becomes_rolling) {
  Wall floor;
  const Real friction = 0.3, speed = 0.5, gravity = 10;
  const Real mass = 2500 * 4.18879020478639e-6, sunk = std::pow(mass * gravity / (4.0 / 3 * 1e8 / (2 * 0.91) * 0.1), 2.0 / 3);
  auto stepper = make_stepper({{.centre = {0, 0, 0.01 - sunk}, .velocity = {speed, 0, 0}}},
                              {.restitution = 0.5, .friction = friction, .step = 2e-6, .gravity = {0, 0, -gravity}}, {floor});
  stepper.start();
  const Real arm = 0.01 - 0.5 * sunk, rolls_at = 2 * speed / (7 * friction * gravity);
  advance(stepper, static_cast<int>(0.5 * rolls_at / 2e-6));
  EXPECT_NEAR(velocity_of(stepper, 0).x(), speed - 0.5 * friction * gravity * rolls_at, 1e-3 * speed);
  advance(stepper, static_cast<int>(1.5 * rolls_at / 2e-6));
  EXPECT_NEAR(velocity_of(stepper, 0).x(), 5.0 / 7 * speed, 2e-3 * speed);
  EXPECT_NEAR(spin_of(stepper, 0).y() * arm, velocity_of(stepper, 0).x(), 2e-3 * speed);
}

/// With resistance to rolling a ball on a slope below the angle whose tangent it is stays where it is.
TEST(sphere_stepper, rolling_friction_holds_a_ball_on_a_slope) {
  for (const Real tangent : {0.08, 0.12}) {
    Wall floor;
    const Vector3 gravity(10 * std::sin(std::atan(tangent)), 0, -10 * std::cos(std::atan(tangent)));
    auto stepper = make_stepper({{.centre = {0, 0, 0.01}}},
                                {.restitution = 0.3, .friction = 0.5, .rolling = 0.1, .step = 5e-6, .gravity = gravity}, {floor});
    stepper.start();
    advance(stepper, 40000);
    const Real speed = velocity_of(stepper, 0).x();
    if (tangent < 0.1)
      EXPECT_LT(std::abs(speed), 1e-6);
    else
      EXPECT_GT(speed, 1e-3);
  }
}

/// A ball that spins about the upright stops after 2 R w / (5 mu_t g), and without resistance to twisting never.
TEST(sphere_stepper, twisting_friction_stops_a_ball_that_spins_where_it_stands) {
  const Real radius = 0.01, spin = 20, gravity = 10, step = 2e-6;
  const Real mass = 2500 * 4.18879020478639e-6, sunk = std::pow(mass * gravity / (4.0 / 3 * 1e8 / (2 * 0.91) * 0.1), 2.0 / 3);
  for (const Real twisting : {0.0, 0.1}) {
    Wall floor;
    auto stepper = make_stepper(
        {{.centre = {0, 0, radius - sunk}, .spin = {0, 0, spin}}},
        {.restitution = 0.5, .friction = 0.5, .twisting = twisting, .step = step, .gravity = {0, 0, -gravity}}, {floor});
    stepper.start();
    const Real stops_at = 0.4 * radius * spin / (0.1 * gravity);
    advance(stepper, static_cast<int>(0.5 * stops_at / step));
    EXPECT_NEAR(spin_of(stepper, 0).z(), twisting > 0 ? 0.5 * spin : spin, 2e-3 * spin);
    advance(stepper, static_cast<int>(0.6 * stops_at / step));
    EXPECT_NEAR(spin_of(stepper, 0).z(), twisting > 0 ? 0 : spin, 2e-3 * spin);
  }
}

TEST(sphere_stepper, keeps_momentum_and_angular_momentum) {
  for (const auto model : {laws::ContactModel::hertz, laws::ContactModel::linear}) {
    auto stepper = make_stepper(
        heap(6, 0.5), {.restitution = 0.7, .friction = 0.4, .rolling = 0.1, .twisting = 0.05, .step = 1e-5, .model = model});
    stepper.start();
    const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
    std::int64_t touched = 0;
    for (int k = 0; k < 2000; ++k) {
      advance(stepper, 1);
      touched += stepper.contacts();
    }
    EXPECT_GT(touched, 1000);
    EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-15);
    EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-15);
  }
}

/// The residual of the energy balance falls with the step.
TEST(sphere_stepper, energy_balance_closes) {
  const auto residual = [](Real step) {
    auto stepper =
        make_stepper(heap(5, 0.5), {.restitution = 0.6, .friction = 0.4, .rolling = 0.1, .twisting = 0.05, .step = step});
    stepper.start();
    const methods::spheres::SphereEnergies first = stepper.energies();
    advance(stepper, static_cast<int>(std::round(0.02 / step)));
    const methods::spheres::SphereEnergies last = stepper.energies();
    EXPECT_GT(last.dashpot_work, 0.05 * first.sum());
    EXPECT_GT(last.sliding_work, 0.01 * first.sum());
    return std::abs(last.sum() - first.sum()) / first.sum();
  };
  EXPECT_LT(residual(1e-5), 2e-3);
  EXPECT_LT(residual(2e-6), 2e-4);
}

TEST(sphere_stepper, a_moving_wall_brings_the_work_in) {
  Wall floor;
  laws::GroundMotion motion;
  motion.shape = laws::GroundMotion::Shape::sine;
  motion.quantity = laws::MotionQuantity::displacement;
  motion.amplitude = 1e-3;
  motion.sine_wave = {50, 0};
  floor.motion.histories.emplace_back(2, motion);
  auto stepper = make_stepper({{.centre = {0, 0, 0.01}}}, {.restitution = 0.5, .step = 2e-6, .gravity = {0, 0, -10}}, {floor});
  stepper.start();
  const Real before = stepper.energies().sum();
  advance(stepper, 50000);
  EXPECT_GT(stepper.energies().wall_work, 1e-5);
  EXPECT_NEAR(stepper.energies().sum(), before, 1e-3 * stepper.energies().wall_work);
}

TEST(sphere_stepper, meets_through_periodic_sides) {
  const state::PeriodicBox box{Vector3::Zero(), Vector3(0.1, 0, 0)};
  auto stepper = make_stepper({{.centre = {0.02, 0, 0}, .velocity = {-1, 0, 0}}, {.centre = {0.08, 0, 0}, .velocity = {1, 0, 0}}},
                              {.step = 1e-6, .box = box});
  stepper.start();
  advance(stepper, 25000);
  EXPECT_NEAR(velocity_of(stepper, 0).x(), 1, 1e-3);
  EXPECT_NEAR(velocity_of(stepper, 1).x(), -1, 1e-3);
}

/// The answer does not follow from how often pairs are sought, but for the order of sums.
/// Two spheres that touch, by looking at all pairs.
std::int64_t touching(const state::Spheres& spheres) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = i + 1; j < spheres.size(); ++j) {
      const auto &one = spheres.place[i], &other = spheres.place[j];
      count += (other.centre() - one.centre()).norm() < one.radius + other.radius ? 1 : 0;
    }
  return count;
}

/// How long a pair is inactive follows from the speeds near it: tiles away from the fast sphere look at theirs more seldom.
TEST(sphere_stepper, finds_every_contact_of_a_fast_sphere_in_a_slow_bed) {
  std::vector<Grain> grains = heap(14, 0.3, 0.0203);  // 2744 spheres: three tiles
  grains.push_back({.centre = {-0.03, 0.15, 0.15}, .radius = 0.015, .velocity = {4, 0.2, 0.1}});
  auto stepper = make_stepper(grains, {.restitution = 0.7, .friction = 0.3, .step = 1e-5});
  stepper.start();
  std::int64_t most = 0;
  for (int look = 0; look < 40; ++look) {
    advance(stepper, 50);
    ASSERT_EQ(stepper.contacts(), touching(stepper.spheres())) << look;
    most = std::max(most, stepper.contacts());
  }
  EXPECT_GT(most, 20);
}

TEST(sphere_stepper, margin_changes_nothing_but_speed) {
  std::vector<Vector3> ends;
  for (const Real margin : {2e-4, 4e-3}) {
    auto stepper = make_stepper(heap(5, 0.5), {.restitution = 0.6, .friction = 0.4, .step = 1e-5, .margin = margin});
    stepper.start();
    advance(stepper, 1000);
    ends.push_back(centre_of(stepper, 62));
  }
  EXPECT_LT((ends[0] - ends[1]).norm(), 1e-10);
}

}  // namespace
}  // namespace sazare::methods::spheres
