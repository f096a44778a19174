/// Bodies on three legs that rest on what turns, and stay where they are on it.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene.hpp"

namespace sazare::methods::spheres {
namespace {

constexpr Real radius = 0.01, leg = 0.02, density = 2500, rate = 10, gravity = 10;
constexpr Real step = 4e-5;  // 4e-4 rad
constexpr int steps_before = 12500, steps_of_a_turn = static_cast<int>(2 * std::numbers::pi / (rate * step) + 0.5);

enum class Floor { plane, mesh, ball };
constexpr Real ball = 0.5;  // radius of the ball on whose pole a body stands

/// Places of the legs, on the table or on the ball, pressed a little.
std::array<Vector3, 3> legs(Floor on, const Vector3& beside) {
  std::array<Vector3, 3> places;
  for (int n = 0; n < 3; ++n) {
    const Real angle = 2 * std::numbers::pi * n / 3;
    places[static_cast<std::size_t>(n)] = beside + Vector3(leg * std::cos(angle), leg * std::sin(angle), 0);
  }
  for (Vector3& place : places) {
    const Real height = radius - 2e-6;
    place.z() = on == Floor::ball ? std::sqrt(std::pow(ball + height, 2) - place.squaredNorm()) - ball : height;
  }
  return places;
}

SphereStepper on_turntable(Floor floor, const Vector3& beside, Real pushed, laws::ContactModel model) {
  const Vector3 spin(0, 0, rate);
  state::Spheres spheres;
  state::Clumps clumps;
  state::Clump clump;
  const auto places = legs(floor, beside);
  const Vector3 centre = (places[0] + places[1] + places[2]) / 3;
  const Real mass = density * 4 * std::numbers::pi / 3 * std::pow(radius, 3);
  clump.centre = centre;
  clump.mass = 3 * mass;
  clump.inertia = mass * Vector3{1.2 * radius * radius + 1.5 * leg * leg, 1.2 * radius * radius + 1.5 * leg * leg,
                                      1.2 * radius * radius + 3 * leg * leg};
  clump.velocity = spin.cross(centre) + pushed * Vector3(1, 0.3, 0);
  clump.angular_momentum = {0, 0, clump.inertia[2] * (rate + 20 * pushed)};
  for (const Vector3& place : places) {
    clumps.members.push_back({static_cast<Index>(spheres.size()), 0, Vector3(place - centre)});
    spheres.add(place, radius, density, 0, true);
    spheres.place.back().mass = clump.mass;
  }
  clumps.clumps.push_back(clump);
  const Rules rules{.restitution = 0.3, .friction = 0.5, .step = step, .gravity = {0, 0, -gravity}, .model = model};
  std::vector<Wall> walls;
  if (floor == Floor::ball) {
    spheres.add({0, 0, -ball}, ball, density, 0, true);
    spheres.set_motion(spheres.size() - 1, Vector3::Zero(), spin);
  } else {
    Wall& wall = walls.emplace_back();
    wall.motion.spin = spin;
    if (floor == Floor::mesh)
      for (int n = 0; n < 5; ++n) {
        const auto corner = [](int k) {
          const Real angle = 2 * std::numbers::pi * k / 5 + 0.1;
          return Vector3(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0);
        };
        wall.triangles.push_back({Vector3::Zero(), corner(n), corner(n + 1)});
      }
  }
  return {spheres, table(rules), std::move(walls), {rules.step, rules.gravity, rules.margin, 5e-3, {}}, {}, clumps};
}

Real azimuth(const Vector3& arm) { return std::atan2(arm.y(), arm.x()); }

/// How far legs and centre have gone back or ahead on the table in some turns after they have come to rest on it [rad].
std::pair<Real, Real> drift(Floor floor, const Vector3& beside, int turns, laws::ContactModel model) {
  // Pushed so that stretches remain, which is what a wrong frame would let creep.
  auto stepper = on_turntable(floor, beside, 2e-3, model);
  stepper.start();
  const auto look = [&] {
    return std::pair{azimuth(centre_of(stepper, 1) - centre_of(stepper, 0)), azimuth(stepper.clumps().clumps[0].centre)};
  };
  for (int n = 0; n < steps_before; ++n) stepper.advance();
  const auto before = look();
  const int steps = turns * steps_of_a_turn;
  for (int n = 0; n < steps; ++n) stepper.advance();
  const auto after = look();
  // What is carried at the speed of the table goes by an angle a in a step: sin a (1 + 2 sin^2(a/2)) = w h, for the velocity
  // that is predicted lags behind by a part of second order.
  const Real turned = rate * step, carried = turned * (1 - turned * turned / 3);
  const auto over = [](Real angle) { return std::remainder(angle, 2 * std::numbers::pi); };
  return {over(after.first - before.first - steps * turned), over(after.second - before.second - steps * carried)};
}

class Turntable : public testing::TestWithParam<laws::ContactModel> {};

TEST_P(Turntable, legs_in_the_middle_stay_where_they_stand) {
  for (const Floor floor : {Floor::plane, Floor::mesh, Floor::ball}) {
    const auto [legs, centre] = drift(floor, Vector3::Zero(), 10, GetParam());
    EXPECT_NEAR(legs, 0, 1e-9) << static_cast<int>(floor);
  }
}

TEST_P(Turntable, legs_beside_the_axis_stay_where_they_stand) {
  for (const Floor floor : {Floor::plane, Floor::mesh}) {
    const auto [legs, centre] = drift(floor, Vector3(0.02, 0.01, 0), 10, GetParam());
    EXPECT_NEAR(legs, 0, 1e-9) << static_cast<int>(floor);
    EXPECT_NEAR(centre, 0, 1e-9) << static_cast<int>(floor);
  }
}

INSTANTIATE_TEST_SUITE_P(turntable, Turntable,
                         testing::Values(laws::ContactModel::hertz, laws::ContactModel::mindlin_deresiewicz));

}  // namespace
}  // namespace sazare::methods::spheres
