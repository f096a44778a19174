#include "sazare/methods/spheres/wall_images.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene.hpp"

namespace sazare::methods::spheres {
namespace {

using geometry::Triangle;

constexpr Real side = 0.1, radius = 0.01, pressed = 0.00995;

state::PeriodicBox room() {
  state::PeriodicBox box;
  box.length = Vector3(side, side, 0);
  return box;
}

void add_plate(Wall& wall, const Vector3& corner, const Vector3& along, const Vector3& up) {
  wall.triangles.push_back({corner, corner + along, corner + along + up});
  wall.triangles.push_back({corner, corner + along + up, corner + up});
}

/// A floor between two places along x, wide along y.
Wall floor_from(Real from, Real to) {
  Wall wall;
  add_plate(wall, {from, -1, 0}, {to - from, 0, 0}, {0, 2, 0});
  return wall;
}

Wall repeated(Wall wall) {
  repeat_wall(wall, room(), radius);
  return wall;
}

Vector3 force_at(const Vector3& centre, const Wall& wall) {
  auto stepper = make_stepper({{.centre = centre}}, {.box = room()}, {wall});
  stepper.start();
  const auto& load = stepper.load(0);
  return {load.fx, load.fy, load.fz};
}

TEST(wall_images, a_floor_that_ends_at_the_sides_is_flat_there) {
  const Wall floor = repeated(floor_from(0, side));
  const Real flat = force_at({0.05, 0.05, pressed}, floor).z();
  EXPECT_GT(flat, 0);
  for (const Real x : {0.0, 1e-5, 0.003, 0.0999, 0.1, 0.1002})
    EXPECT_LT((force_at({x, 0.05, pressed}, floor) - Vector3(0, 0, flat)).norm(), 1e-9 * flat) << x;
}

/// A ball in a gap leans on both edges, wherever the side of the room cuts the gap.
TEST(wall_images, a_floor_that_ends_short_of_a_side_has_a_gap_between_two_edges) {
  const Real gap = 0.006, depth = std::sqrt(pressed * pressed - gap * gap / 4);
  const Wall symmetric = repeated(floor_from(gap / 2, side - gap / 2));
  const Vector3 force = force_at({0, 0.05, depth}, symmetric);
  EXPECT_GT(force.z(), 0);
  EXPECT_NEAR(force.x(), 0, 1e-9 * force.z());
  const Wall at_one_side = repeated(floor_from(0, side - gap));
  const Vector3 same = force_at({side - gap / 2, 0.05, depth}, at_one_side);
  EXPECT_LT((same - force).norm(), 1e-9 * force.norm());
  // Before they are repeated the ball is pushed by one of the edges alone.
  EXPECT_GT(std::abs(force_at({side - gap / 2, 0.05, depth}, floor_from(0, side - gap)).x()), 0.1 * force.z());
}

TEST(wall_images, a_bump_at_one_side_is_met_from_the_other_one) {
  Wall wall = floor_from(0, side);
  add_plate(wall, {0, -1, 0}, {0, 2, 0}, {0, 0, 0.05});
  const Vector3 force = force_at({side - pressed, 0.05, 0.02}, repeated(wall));
  EXPECT_LT(force.x(), 0);
}

TEST(wall_images, a_ball_rolls_through_the_side_as_on_one_floor) {
  const auto roll = [](const Wall& wall) {
    auto stepper =
        make_stepper({{.centre = {0.02, 0.05, 0.00999}, .velocity = {2, 0.3, 0}}},
                     {.restitution = 0.5, .friction = 0.3, .step = 5e-6, .gravity = {0, 0, -10}, .box = room()}, {wall});
    stepper.start();
    advance(stepper, 40000);
    return velocity_of(stepper, 0);
  };
  // Many narrow strips, so that none is near both sides.
  Wall strips, wide;
  for (int n = 0; n < 10; ++n) add_plate(strips, {0.1 * side * n, 0, 0}, {0.1 * side, 0, 0}, {0, side, 0});
  add_plate(wide, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  EXPECT_LT((roll(repeated(strips)) - roll(wide)).norm(), 1e-6);
}

TEST(wall_images, a_belt_that_moves_along_the_room_has_no_end) {
  const auto carried = [](Wall belt) {
    laws::GroundMotion motion;
    motion.shape = laws::GroundMotion::Shape::record;
    motion.quantity = laws::MotionQuantity::velocity;
    motion.record = laws::Record::make(0.1, {5, 5, 5});
    belt.motion.histories.emplace_back(0, motion);
    auto stepper =
        make_stepper({{.centre = {0.02, 0.05, 0.00999}}},
                     {.restitution = 0.5, .friction = 0.3, .step = 5e-6, .gravity = {0, 0, -10}, .box = room()}, {belt});
    stepper.start();
    advance(stepper, 20000);
    return velocity_of(stepper, 0);
  };
  const Vector3 on_long = carried(floor_from(-10, 10)), on_short = carried(repeated(floor_from(0, side)));
  EXPECT_GT(on_long.x(), 0.25);
  EXPECT_LT((on_short - on_long).norm(), 1e-6);
}

TEST(wall_images, a_floor_longer_than_the_room_on_one_side_has_its_next_images_alone) {
  const Wall floor = repeated(floor_from(0, 20 * side));
  EXPECT_EQ(floor.triangles.size(), 6);
  const Real flat = force_at({0.05, 0.05, pressed}, floor).z();
  EXPECT_LT((force_at({0, 0.05, pressed}, floor) - Vector3(0, 0, flat)).norm(), 1e-9 * flat);
}

TEST(wall_images, which_walls_repeat_themselves) {
  const auto sides = [](const Wall& wall) { return sides_of(wall, room(), 0, radius); };
  EXPECT_FALSE(sides(floor_from(-0.01, side + 0.01)).repeats) << "it reaches beyond both sides";
  EXPECT_TRUE(sides(floor_from(-0.01, side)).repeats);
  EXPECT_NEAR(sides(floor_from(0, side - 0.002)).gap, 0.002, 1e-12);
  EXPECT_FALSE(sides_of(floor_from(0, side), room(), 2, radius).repeats) << "the room does not";
  Wall drum = floor_from(0, side);
  drum.motion.spin = Vector3(3, 0, 0);
  EXPECT_TRUE(sides(drum).can) << "it turns within its images";
  drum.motion.spin = Vector3(0, 0, 3);
  EXPECT_FALSE(sides(drum).can);
  Wall blade;
  add_plate(blade, {0.03, 0.05, 0}, {0.04, 0, 0}, {0, 0, 0.02});
  blade.motion.spin = Vector3(0, 0, 3);
  blade.motion.pivot = Vector3(0.05, 0.05, 0);
  EXPECT_TRUE(sides(blade).can) << "it stays away from the sides";
  blade.motion.pivot = Vector3(0.03, 0.05, 0);
  EXPECT_FALSE(sides(blade).can);
}

}  // namespace
}  // namespace sazare::methods::spheres
