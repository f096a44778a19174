#include <gtest/gtest.h>

#include <numbers>

#include "sazare/geometry/nodal_surface.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

using geometry::FacePoint, geometry::NodalSurface;

const Real pressed = 0.00995;  // height of a sphere of 0.01 m

/// A square about the origin, cut into triangles around a node in its middle.
Wall fan(int pieces) {
  std::vector<Vector3> nodes = {Vector3::Zero()};
  std::vector<std::array<Index, 3>> faces;
  for (int n = 0; n < pieces; ++n) {
    const Real angle = 2 * std::numbers::pi * n / pieces;
    nodes.emplace_back(std::cos(angle), std::sin(angle), 0);
    faces.push_back({0, n + 1, (n + 1) % pieces + 1});
  }
  Wall wall;
  wall.nodal = NodalSurface(nodes, faces);
  return wall;
}

methods::spheres::SphereStepper on_fan(const std::vector<Grain>& grains, const Rules& rules, int pieces) {
  auto stepper = make_stepper(grains, rules);
  stepper.add_surface(fan(pieces));
  stepper.start();
  return stepper;
}

/// Nodes of the fan that turn, bend and run away at once.
std::vector<Vector3> bending(const std::vector<Vector3>& nodes) {
  std::vector<Vector3> velocities;
  for (const Vector3& node : nodes)
    velocities.push_back(Vector3(0.3, -0.1, 0.2) + Vector3(0, 0.2, 1).cross(node) + Vector3(0, 0, 0.5 * node.squaredNorm()));
  return velocities;
}

std::vector<Vector3> nodes_of(int pieces) {
  const Wall wall = fan(pieces);
  std::vector<Vector3> nodes(static_cast<std::size_t>(pieces) + 1, Vector3::Zero());
  for (int n = 0; n < pieces; ++n) nodes[static_cast<std::size_t>(n) + 1] = wall.nodal.corners(static_cast<std::size_t>(n), 0)[1];
  return nodes;
}

TEST(nodal_surface, pushes_once_wherever_its_edges_are) {
  const Real once = on_fan({{.centre = {0.3, 1e-5, pressed}}}, {}, 3).load(0).fz;
  EXPECT_GT(once, 0);
  for (const int pieces : {3, 7, 40})
    for (const Vector3& place : {Vector3(0, 0, pressed), Vector3(1e-4, 0, pressed), Vector3(5e-4, 3e-4, pressed)})
      EXPECT_NEAR(on_fan({{.centre = place}}, {}, pieces).load(0).fz, once, 1e-9 * once) << pieces;
}

TEST(nodal_surface, its_nodes_get_the_force_and_the_moment_that_spheres_get_turned_round) {
  auto stepper = on_fan({{.centre = {0.2, 0.1, pressed}, .velocity = {0.5, 0, 0}, .spin = {3, 0, 1}}},
                        {.friction = 0.3, .rolling = 0.1, .twisting = 0.05}, 5);
  stepper.lead(nodes_of(5), bending(nodes_of(5)));
  advance(stepper, 5);
  const auto& load = stepper.load(0);
  const Vector3 force(load.fx, load.fy, load.fz), moment(load.mx, load.my, load.mz);
  const auto velocities = bending(nodes_of(5));
  Vector3 sum = Vector3::Zero(), turning = Vector3::Zero();
  for (std::size_t n = 0; n < velocities.size(); ++n) {
    const Vector3 place = nodes_of(5)[n] + stepper.time() * velocities[n];
    sum += stepper.walls().surface()->force()[n];
    turning += place.cross(stepper.walls().surface()->force()[n]);
  }
  EXPECT_GT(std::hypot(force.x(), force.y()), 0.02 * force.norm());
  EXPECT_LT((sum + force).norm(), 1e-12 * force.norm());
  EXPECT_LT((turning + moment + centre_of(stepper, 0).cross(force)).norm(), 1e-12 * force.norm());
}

TEST(nodal_surface, does_the_work_of_its_nodes) {
  const std::vector<Vector3> velocities = {{1, 2, 3}, {-1, 0.5, 2}, {0.3, 0.2, -1}};
  FacePoint point{{0, 1, 2}, {Vector3(0, 0, 0), Vector3(1, 0.2, 0), Vector3(0.3, 2, 0.5)}, {0.2, 0.3, 0.5}, {}};
  std::ranges::copy(velocities, point.velocities.begin());
  const Vector3 force(3, -2, 7), couple(0.5, 1, -2);
  const auto shared = point.on_corners(force, couple);
  Real power = 0;
  Vector3 sum = Vector3::Zero(), moment = Vector3::Zero(), place = Vector3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    power += shared[k].dot(velocities[k]);
    sum += shared[k];
    moment += point.corners[k].cross(shared[k]);
    place += point.shares[k] * point.corners[k];
  }
  EXPECT_LT((sum - force).norm(), 1e-14 * force.norm());
  EXPECT_LT((moment - place.cross(force) - couple).norm(), 1e-13 * force.norm());
  EXPECT_NEAR(power, force.dot(point.velocity()) + couple.dot(point.spin()), 1e-12);
}

TEST(nodal_surface, turns_as_a_rigid_body_does) {
  const Vector3 spin(0.4, -1, 2);
  FacePoint point{{0, 1, 2}, {Vector3(0, 0, 0), Vector3(1, 0.2, 0), Vector3(0.3, 2, 0.5)}, {0.2, 0.3, 0.5}, {}};
  for (std::size_t k = 0; k < 3; ++k) point.velocities[k] = Vector3(1, 2, 3) + spin.cross(point.corners[k]);
  EXPECT_LT((point.spin() - spin).norm(), 1e-13);
}

TEST(nodal_surface, its_work_is_what_an_elastic_ball_gains_and_its_impulse_what_the_ball_loses) {
  auto stepper = on_fan({{.centre = {0.2, 0.1, 0.0105}, .velocity = {0, 0, -1}}}, {.step = 2e-7}, 5);
  const auto nodes = nodes_of(5), velocities = std::vector<Vector3>(nodes.size(), Vector3(0.2, 0, 0.7));
  stepper.lead(nodes, velocities);
  const Real before = stepper.energies().sum() + stepper.energies().wall_work;
  const Vector3 momentum = stepper.momentum();
  advance(stepper, 20000);
  EXPECT_EQ(stepper.contacts(), 0);
  EXPECT_NEAR(velocity_of(stepper, 0).z(), 2 * 0.7 + 1, 1e-4);  // elastic, off a wall without end
  const Real gained = stepper.energies().sum() + stepper.energies().wall_work - before;
  EXPECT_NEAR(gained, stepper.energies().wall_work, 1e-4 * gained);
  Vector3 impulse = Vector3::Zero();
  for (const Vector3& one : stepper.walls().surface()->impulse()) impulse += one;
  EXPECT_LT((impulse + stepper.momentum() - momentum).norm(), 1e-13 * impulse.norm());
}

TEST(nodal_surface, goes_on_from_a_checkpoint_as_if_nothing_had_been) {
  const Rules rules{
      .restitution = 0.6, .friction = 0.4, .rolling = 0.05, .twisting = 0.02, .step = 1e-5, .gravity = {0, 0, -9.81}};
  const auto make = [&] {
    std::vector<Grain> grains = heap(8, 0.5, 0.0195);
    for (Grain& grain : grains) grain.centre -= Vector3(0.05, 0.05, 0.009);
    return make_stepper(grains, rules);
  };
  auto through = make(), resumed = make();
  through.add_surface(fan(6));
  resumed.add_surface(fan(6));
  through.start();
  through.lead(nodes_of(6), bending(nodes_of(6)));
  advance(through, 777);
  test::MemoryArchive checkpoint;
  through.columns(checkpoint);
  checkpoint.turn_round();
  resumed.columns(checkpoint);
  advance(through, 300);
  advance(resumed, 300);
  test::MemoryArchive one, other;
  through.columns(one);
  resumed.columns(other);
  EXPECT_GT(through.contacts(), 30);
  EXPECT_TRUE(one == other);
}

}  // namespace
}  // namespace sazare::methods::spheres
