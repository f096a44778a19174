#include <gtest/gtest.h>

#include "scene.hpp"

namespace sazare::methods::spheres {
namespace {

/// A square in the plane z = 0, of two triangles.
Wall plate(Real from, Real to) {
  const Vector3 a(from, from, 0), b(to, from, 0), c(to, to, 0), d(from, to, 0);
  Wall wall;
  wall.triangles = {{a, b, c}, {a, c, d}};
  return wall;
}

/// A ball that begins 0.1 m above the plate and goes down.
methods::spheres::SphereStepper shot(Real speed, Real step, const Wall& wall, Real x = 0.02) {
  return make_stepper({{.centre = {x, 0.03, 0.1}, .velocity = {0, 0, -speed}}}, {.step = step}, {wall});
}

/// Steps until something is seen or the ball is far below.
void fly(methods::spheres::SphereStepper& stepper) {
  while (!stepper.passage() && stepper.missed_way() == 0 && centre_of(stepper, 0).z() > -0.5 && centre_of(stepper, 0).z() < 0.3)
    stepper.advance();
  stepper.evaluate_now();
}

TEST(wall_passages, a_ball_that_a_surface_throws_back_passes_none) {
  auto stepper = shot(50, 1e-6, plate(-1, 1));
  stepper.start();
  fly(stepper);
  EXPECT_FALSE(stepper.passage());
  EXPECT_EQ(stepper.missed_way(), 0);
  EXPECT_GT(velocity_of(stepper, 0).z(), 49);
}

TEST(wall_passages, a_contact_too_soft_for_the_speed_is_seen) {
  auto stepper = shot(150, 1e-6, plate(-1, 1));
  stepper.start();
  fly(stepper);
  ASSERT_TRUE(stepper.passage());
  EXPECT_EQ(stepper.passage()->sphere, 0);
  EXPECT_EQ(stepper.passage()->wall, 0);
  EXPECT_NEAR(stepper.passage()->time, 0.1 / 150, 1e-4);
  EXPECT_LT(stepper.passage()->centre.z(), 0);
}

/// Up to two radii in a step, and from places that differ by less than a step, so that searches and hits fall in any order.
TEST(wall_passages, a_ball_that_jumps_over_a_surface_is_seen_wherever_it_begins) {
  for (const Real way : {0.006, 0.0099, 0.0101, 0.0141})
    for (int n = 0; n < 20; ++n) {
      auto stepper = make_stepper({{.centre = {0.02, 0.03, 0.1 + 0.05 * n * way}, .velocity = {0, 0, -way / 1e-5}}},
                                  {.step = 1e-5}, {plate(-1, 1)});
      stepper.start();
      fly(stepper);
      EXPECT_TRUE(stepper.passage() || velocity_of(stepper, 0).z() > 0) << way << " " << n;
      EXPECT_EQ(stepper.missed_way(), 0);
    }
}

TEST(wall_passages, a_step_that_no_list_of_neighbours_bears_is_told) {
  auto stepper = shot(4000, 1e-5, plate(-1, 1));
  stepper.start();
  stepper.advance();
  EXPECT_NEAR(stepper.missed_way(), 0.04, 1e-12);
}

TEST(wall_passages, beside_a_plate_nothing_passes) {
  auto stepper = shot(150, 1e-6, plate(-1, 0), 0.02);
  stepper.start();
  fly(stepper);
  EXPECT_FALSE(stepper.passage());
  EXPECT_LT(centre_of(stepper, 0).z(), -0.4);
}

TEST(wall_passages, are_the_same_in_the_frame_of_a_wall_that_moves) {
  Wall wall = plate(-1, 1);
  wall.motion.spin = Vector3(0, 150, 0);  // at x = -1 the plate rises with 150 m/s
  auto stepper = make_stepper({{.centre = {-0.9, 0.03, 0.1}}}, {.step = 1e-6}, {wall});
  stepper.start();
  while (!stepper.passage() && stepper.steps() < 2000) stepper.advance();
  ASSERT_TRUE(stepper.passage());
  EXPECT_LT(stepper.passage()->time, 2e-3);
}

TEST(wall_passages, are_seen_at_levels_too) {
  auto stepper =
      make_stepper({{.centre = {0.02, 0.03, 0.1}, .velocity = {0, 0, -150}}, {.centre = {0.5, 0.5, 0.5}, .radius = 0.0025}},
                   {.step = 2e-6, .level = {0, 2}}, {plate(-1, 1)});
  stepper.start();
  while (!stepper.passage() && stepper.steps() < 2000) stepper.advance();
  ASSERT_TRUE(stepper.passage());
  EXPECT_EQ(stepper.passage()->sphere, 0);
}

/// Through a periodic side and back again beside a plate across the room.
TEST(wall_passages, to_leave_a_room_on_one_side_and_enter_it_on_the_other_is_none) {
  Wall wall;
  wall.triangles = {{Vector3(0.1, -1, -1), Vector3(0.1, 1, -1), Vector3(0.1, 0, 2)}};
  state::PeriodicBox box;
  box.length.x() = 0.2;
  auto stepper = make_stepper({{.centre = {0.15, 0, 0}, .velocity = {1, 0, 0}}}, {.step = 1e-5, .box = box}, {wall});
  stepper.start();
  advance(stepper, 20000);
  EXPECT_FALSE(stepper.passage());
  EXPECT_LT(velocity_of(stepper, 0).x(), 0) << "it has come round to the plate and was thrown back";
}

}  // namespace
}  // namespace sazare::methods::spheres
