#include "sazare/methods/spheres/wall_contacts.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "scene.hpp"

namespace sazare::methods::spheres {
namespace {

using geometry::Triangle;

Wall surface(std::vector<Triangle> triangles) {
  Wall wall;
  wall.triangles = std::move(triangles);
  return wall;
}

/// A square in the plane z = 0 about the origin, cut into triangles around it.
Wall fan(int pieces) {
  std::vector<Triangle> triangles;
  for (int n = 0; n < pieces; ++n) {
    const Real a = 2 * std::numbers::pi * n / pieces, b = 2 * std::numbers::pi * (n + 1) / pieces;
    triangles.push_back({Vector3::Zero(), Vector3(std::cos(a), std::sin(a), 0), Vector3(std::cos(b), std::sin(b), 0)});
  }
  return surface(triangles);
}

/// Force of walls on a sphere at rest.
Vector3 force_at(const Vector3& centre, const std::vector<Wall>& walls) {
  auto stepper = make_stepper({{.centre = centre}}, {}, walls);
  stepper.start();
  const auto& load = stepper.load(0);
  return {load.fx, load.fy, load.fz};
}

const Real pressed = 0.00995;  // height of a sphere of 0.01 m

TEST(wall_contacts, a_flat_surface_pushes_once_wherever_its_edges_are) {
  const Vector3 plane = force_at({0, 0, pressed}, {Wall{}});
  EXPECT_GT(plane.z(), 0);
  for (const int pieces : {3, 7, 40})
    for (const Vector3& place :
         {Vector3(0, 0, pressed), Vector3(1e-4, 0, pressed), Vector3(5e-4, 3e-4, pressed), Vector3(0.3, 1e-5, pressed)}) {
      const Vector3 force = force_at(place, {fan(pieces)});
      EXPECT_NEAR((force - plane).norm(), 0, 1e-9 * plane.z()) << pieces << " " << place.transpose();
    }
}

TEST(wall_contacts, an_outer_edge_and_a_corner_push_once) {
  // Three faces of a cube that meet at the origin, which is its highest corner.
  const Vector3 x(1, 0, -1), y(-0.5, 0.8, -1), z(-0.5, -0.8, -1), o = Vector3::Zero();
  const std::vector<Wall> corner = {surface({{o, x, y}, {o, y, z}, {o, z, x}})};
  const Vector3 plane = force_at({0, 0, pressed}, {Wall{}});
  EXPECT_NEAR((force_at({0, 0, pressed}, corner) - plane).norm(), 0, 1e-9 * plane.z());
  const Vector3 on_edge = 0.1 * x + pressed * Vector3(1, 0, 1).normalized();
  EXPECT_NEAR(force_at(on_edge, corner).norm(), plane.z(), 1e-9 * plane.z());
}

TEST(wall_contacts, both_sides_of_a_groove_push) {
  const std::vector<Wall> groove = {surface(
      {{Vector3(-1, -1, 0), Vector3(1, -1, 0), Vector3(0, 1, 0)}, {Vector3(0, -1, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}})};
  const Vector3 plane = force_at({0, 0, pressed}, {Wall{}});
  const Vector3 force = force_at({pressed, 0, pressed}, groove);
  EXPECT_NEAR(force.x(), plane.z(), 1e-9 * plane.z());
  EXPECT_NEAR(force.z(), plane.z(), 1e-9 * plane.z());
}

TEST(wall_contacts, both_sides_of_a_surface_push) { EXPECT_LT(force_at({0.1, 0.1, -pressed}, {fan(5)}).z(), 0); }

TEST(wall_contacts, friction_remembers_across_edges) {
  for (const auto model : {laws::ContactModel::hertz, laws::ContactModel::mindlin_deresiewicz}) {
    const auto slide = [&](const Wall& wall) {
      auto stepper =
          make_stepper({{.centre = {-0.05, 0.003, 0.01}, .velocity = {1, 0.1, 0}}},
                       {.restitution = 0.5, .friction = 0.3, .step = 2e-6, .gravity = {0, 0, -10}, .model = model}, {wall});
      stepper.start();
      advance(stepper, 50000);
      return velocity_of(stepper, 0);
    };
    const Vector3 on_plane = slide(Wall{}), on_fan = slide(fan(12));
    EXPECT_LT(on_plane.x(), 0.75);
    EXPECT_LT((on_plane - on_fan).norm(), 1e-6);
  }
}

TEST(wall_contacts, force_and_moment_on_the_wall_are_those_on_the_sphere_turned_round) {
  auto stepper = make_stepper({{.centre = {0.2, 0.1, pressed}, .velocity = {0.5, 0, 0}, .spin = {3, 0, 1}}},
                              {.friction = 0.3, .rolling = 0.1, .twisting = 0.05}, {Wall{}});
  stepper.start();
  advance(stepper, 3);
  const auto& load = stepper.load(0);
  const auto wall = stepper.walls().loads().front();
  const Vector3 force(load.fx, load.fy, load.fz), moment(load.mx, load.my, load.mz);
  EXPECT_LT((wall.force + force).norm(), 1e-12 * force.norm());
  EXPECT_LT((wall.moment + moment + centre_of(stepper, 0).cross(force)).norm(), 1e-12 * force.norm());
}

TEST(wall_contacts, a_turning_wall_takes_a_ball_along) {
  Wall wall = fan(6);
  wall.motion.spin = Vector3(0, 0, 2);
  auto stepper =
      make_stepper({{.centre = {0.1, 0, pressed}}},
                   {.restitution = 0.5, .friction = 0.5, .rolling = 0.5, .step = 2e-6, .gravity = {0, 0, -10}}, {wall});
  stepper.start();
  advance(stepper, 50000);
  EXPECT_GT(velocity_of(stepper, 0).y(), 0.1);
}

TEST(wall_contacts, keep_a_ball_dropped_on_a_wall_of_triangles) {
  auto stepper =
      make_stepper({{.centre = {0.01, 0.02, 0.1}}}, {.restitution = 0.5, .step = 1e-5, .gravity = {0, 0, -10}}, {fan(9)});
  stepper.start();
  advance(stepper, 100000);
  EXPECT_NEAR(centre_of(stepper, 0).z(), 0.01, 2e-5);
  EXPECT_LT(velocity_of(stepper, 0).norm(), 1e-6);
}

}  // namespace
}  // namespace sazare::methods::spheres
