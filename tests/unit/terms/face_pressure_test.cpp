#include <gtest/gtest.h>

#include <cmath>

#include "sazare/levels/terms/face_pressure.hpp"
#include "tests/support/force_probe.hpp"

namespace sazare::terms {
namespace {

/// One body with one face of 0.5 m2, a metre from its centre along x; the probe's ticks are seconds.
struct PressedBody {
  explicit PressedBody(PressureLoad load)
      : bodies(one_body()), pressure({std::move(load)}, {face(bodies)}, bodies), probe(pressure, bodies) {}

  static state::Bodies<3> one_body() {
    state::Bodies<3> made;
    state::add_body(made, 2.0, Vector3(0, 0, 0), Vector3(1, 2, 3), Quaternion::Identity(), 1.0);
    return made;
  }
  static PressedFace face(const state::Bodies<3>&) {
    return {.area = Vector3(0.5, 0, 0), .centre = Vector3(1, 0.2, 0), .start = Vector3(1, 0.2, 0)};
  }

  state::Impulse<3> force() { return probe.forces()[0]; }

  state::Bodies<3> bodies;
  FacePressure pressure;
  test::ForceProbe<3> probe;
};

PressureLoad constant(Real pascals) {
  PressureLoad load;
  load.history = laws::PressureTable{{0, 1000}, {pascals, pascals}};
  return load;
}

TEST(face_pressure, pushes_into_the_body_by_pressure_times_area) {
  PressedBody pressed(constant(1e6));
  const auto force = pressed.force();
  EXPECT_LT((force.linear - Vector3(-0.5e6, 0, 0)).norm(), 1e-9);
  EXPECT_LT((force.angular - Vector3(1, 0.2, 0).cross(force.linear)).norm(), 1e-9);
}

TEST(face_pressure, turns_with_its_body) {
  PressedBody pressed(constant(1e6));
  pressed.bodies.motion[0].rotation = Eigen::AngleAxis<Real>(M_PI / 2, Vector3::UnitZ()).toRotationMatrix();
  EXPECT_LT((pressed.force().linear - Vector3(0, -0.5e6, 0)).norm(), 1e-9);
}

TEST(face_pressure, follows_its_history_from_the_delay_on) {
  PressureLoad load;
  load.delay = 2;  // seconds: the probe's first evaluation stands at one second
  load.history = laws::PressureTable{{0, 2}, {1e6, 3e6}};
  PressedBody pressed(load);
  EXPECT_EQ(pressed.force().linear.norm(), 0);                // 1 s
  EXPECT_NEAR(pressed.force().linear.x(), -0.5e6, 1e-9);      // 2 s
  EXPECT_NEAR(pressed.force().linear.x(), -0.5 * 2e6, 1e-9);  // 3 s
  EXPECT_NEAR(pressed.force().linear.x(), -0.5 * 3e6, 1e-9);  // 4 s
  EXPECT_EQ(pressed.force().linear.norm(), 0);                // 5 s
}

TEST(face_pressure, fires_the_pulse_of_a_blast) {
  PressureLoad load;
  load.history = laws::BlastPressure{5e8, 2, 3};
  PressedBody pressed(load);
  EXPECT_NEAR(pressed.force().linear.x(), -0.5 * 2.5e8, 1e-3);  // half of the rise
  EXPECT_NEAR(pressed.force().linear.x(), -0.5 * 5e8, 1e-3);    // the peak
}

TEST(face_pressure, is_cut_for_good_once_its_face_is_far_out) {
  PressureLoad load = constant(1e6);
  load.cut_distance = 0.1;
  PressedBody pressed(load);
  auto& position = pressed.bodies.motion[0].position;
  position.x() = 0.09;
  EXPECT_GT(pressed.force().linear.norm(), 0);
  position.x() = 0.11;
  EXPECT_EQ(pressed.force().linear.norm(), 0);
  position.x() = 0;  // it does not come back
  EXPECT_EQ(pressed.force().linear.norm(), 0);
}

TEST(face_pressure, never_cut_unless_asked) {
  PressedBody pressed(constant(1e6));
  pressed.bodies.motion[0].position.x() = 1e6;
  EXPECT_NEAR(pressed.force().linear.x(), -0.5e6, 1e-9);
}

TEST(face_pressure, adds_the_work_at_the_mean_motion_of_the_kick) {
  PressedBody pressed(constant(1e6));
  pressed.force();
  const MeanMotion<3> mean{Vector3(-2, 0, 0), Vector3::Zero()};
  EXPECT_NEAR(pressed.probe.work(0, mean)[static_cast<std::size_t>(Cause::load)], 0.5e6 * 2, 1e-6);
}

}  // namespace
}  // namespace sazare::terms
