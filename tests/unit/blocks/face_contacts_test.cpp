/// Contact of the true faces of blocks, through whole simulations.

#include "sazare/methods/blocks/true_faces/face_contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/blocks_scene.hpp"
#include "tests/support/box_of_blocks.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind, test::run;

runs::BlocksModel started(const cases::BlocksCase& blocks, geometry::TetraMesh mesh) {
  auto model = runs::build_blocks(blocks, std::move(mesh));
  model.simulation->start();
  return model;
}

void touch_by_faces(cases::BlocksCase& blocks, Real stiffness) {
  blocks.contact = {};
  blocks.contact.shape = cases::ContactShape::faces;
  blocks.contact.face_stiffness = stiffness;
}

/// Two blocks that were never bonded, the second one moved away from the first and turned about its centre.
geometry::TetraMesh blocks_apart(const Vector3& away, const Vector3& turn = Vector3::Zero()) {
  geometry::TetraMesh mesh = test::two_blocks();
  for (const std::size_t node : {0, 1, 2}) mesh.nodes.push_back(mesh.nodes[node]);
  mesh.tetrahedra[1] = {4, 5, 7, 6};
  Vector3 centre = Vector3::Zero();
  for (const Index node : mesh.tetrahedra[1]) centre += mesh.nodes[at(node)] / 4;
  const Real angle = turn.norm();
  const Matrix3 rotation = angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Matrix3(Matrix3::Identity());
  for (const Index node : mesh.tetrahedra[1]) {
    Vector3& place = mesh.nodes[at(node)];
    place = centre + away + rotation * (place - centre);
  }
  return mesh;
}

/// Two blocks on their way towards each other.
cases::BlocksCase towards(const Vector3& velocity, Real stiffness) {
  auto blocks = test::two_block_case(false);
  blocks.joints.clear();
  test::move(blocks, "left", velocity);
  test::move(blocks, "right", -velocity);
  touch_by_faces(blocks, stiffness);
  return blocks;
}

Real kinetic_at_start(const runs::BlocksModel& model) {
  Real sum = 0;
  for (std::size_t body = 0; body < model.simulation->bodies().motion.size(); ++body)
    sum += 0.5 * model.simulation->bodies().inertia[body].mass * model.simulation->bodies().motion[body].velocity.squaredNorm();
  return sum;
}

TEST(face_contacts, blocks_that_touch_at_rest_stay_at_rest) {
  auto model = started(towards(Vector3::Zero(), 1e12), blocks_apart(Vector3::Zero()));
  EXPECT_EQ(model.contacts->pair_count(), 1);
  run(model, 200);
  for (const Vector3& velocity : model.simulation->snapshot().velocity) EXPECT_LT(velocity.norm(), 1e-12);
}

/// Face on face, edge on edge, corner on face: whatever two blocks meet with.
TEST(face_contacts, an_elastic_impact_keeps_the_energy) {
  for (const Vector3& turn :
       {Vector3(0, 0, 0), Vector3(0.3, 0.2, 0.5), Vector3(1, 2, -1), Vector3(0, 0, 3), Vector3(2, 0.3, 1)}) {
    auto blocks = towards({2, 0.3, 0.2}, 1e9);
    blocks.time.base_step = 4e-7;
    auto model = runs::build_blocks(blocks, blocks_apart({0.03, 0, 0}, turn));
    const Real given = kinetic_at_start(model);
    model.simulation->start();
    Real stored = 0, worst = 0;
    for (int step = 0; step < 40000; ++step) {
      run(model, 1);
      if (step % 10 != 0) continue;
      const auto balance = model.simulation->energy_balance();
      stored = std::max(stored, balance[EnergyKind::elastic]);
      worst = std::max(worst, std::abs(balance.residual()));
    }
    EXPECT_GT(stored, 0.1 * given) << turn.transpose();
    EXPECT_LT(worst, 1e-5 * given) << turn.transpose();  // the energy of the leapfrog swings while they touch
    EXPECT_LT(std::abs(model.simulation->energy_balance().residual()), 1e-6 * given) << turn.transpose();
  }
}

TEST(face_contacts, action_equals_reaction_through_a_rough_collision) {
  auto blocks = towards({2, 0.3, 0.2}, 1e10);
  blocks.contact.friction_coefficient = 0.5;
  blocks.contact.face_damping = 1e6;
  blocks.time.base_step = 1e-6;
  auto model = runs::build_blocks(blocks, blocks_apart({0.005, 0, 0}, {0.3, 0.2, 0.5}));
  const Real given = kinetic_at_start(model);
  model.simulation->start();
  const test::Momenta before = test::momenta_of(model);
  run(model, 8000);
  const auto balance = model.simulation->energy_balance();
  const test::Momenta after = test::momenta_of(model);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-14);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-14);
  EXPECT_GT(balance[EnergyKind::friction], 1e-3);
  EXPECT_GT(balance[EnergyKind::contact_dashpot], 1e-3);
  EXPECT_LT(std::abs(balance.residual()), 1e-5 * given);
}

/// What overlaps at the beginning is not pushed apart; what comes on top of it is, and after they have parted all is.
TEST(face_contacts, blocks_that_overlap_when_they_meet_rest_until_they_part) {
  constexpr Real depth = 1e-4;
  auto blocks = towards({0.1, 0, 0}, 1e9);
  blocks.time.base_step = 4e-7;
  auto still = blocks;
  still.initial_velocities.clear();
  auto resting = started(still, blocks_apart({-depth, 0, 0}));
  run(resting, 100);
  EXPECT_LT(resting.simulation->snapshot().velocity[0].norm(), 1e-9);
  EXPECT_LT(resting.simulation->energy_balance()[EnergyKind::elastic], 1e-11);

  auto model = runs::build_blocks(blocks, blocks_apart({-depth, 0, 0}));
  const Real given = kinetic_at_start(model);
  model.simulation->start();
  Real stored = 0;
  for (int step = 0; step < 20000; ++step) {
    run(model, 1);
    stored = std::max(stored, model.simulation->energy_balance()[EnergyKind::elastic]);
  }
  EXPECT_NEAR(stored, given, 1e-4 * given);
  EXPECT_NEAR(model.simulation->snapshot().velocity[0].x(), -0.1, 1e-6);
  EXPECT_LT(std::abs(model.simulation->energy_balance().residual()), 1e-6 * given);
}

constexpr Real gravity = 9.8, floor_size = 0.05, cube_size = 0.06;

/// A floor that is held, with seams askew, and a cube of six blocks on it.
geometry::TetraMesh cube_on_floor() {
  geometry::TetraMesh mesh;
  const auto askew = [](const Vector3& place) -> Vector3 {
    return 0.15 * floor_size * Vector3(std::sin(90 * place.y() + 37 * place.x()), std::sin(70 * place.x() + 1), 0);
  };
  test::add_box(mesh, {"floor", {-0.1, -0.08, -floor_size}, {12, 3, 1}, floor_size}, askew);
  test::add_box(mesh, {"cube", {-0.04, -0.033, 0}, {1, 1, 1}, cube_size});
  return mesh;
}

cases::BlocksCase sliding(Real speed) {
  cases::BlocksCase blocks;
  blocks.materials = {{"stone", {"floor", "cube"}, 2400.0}};
  cases::Joint joint = test::concrete_joint("stone", "stone");
  joint.normal_stiffness = 2e9;
  joint.shear_stiffness = 1e9;
  joint.normal_damping = joint.shear_damping = 0;
  joint.cohesion = joint.tensile_strength = 1e7;
  joint.fracture_energy = 1e6;
  blocks.joints = {joint};
  touch_by_faces(blocks, 2e9);
  blocks.gravity.acceleration = {0, 0, -gravity};
  cases::Constraint held;
  held.regions = {"floor"};
  held.translation = held.rotation = {true, true, true};
  blocks.constraints = {held};
  test::move(blocks, "cube", {speed, 0, 0});
  blocks.time.history_interval = 1e-4;
  blocks.time.base_step = 1.5e-5;
  blocks.time.limiter = cases::Limiter::stability;
  return blocks;
}

struct Mean {
  Real mass = 0;
  Vector3 velocity = Vector3::Zero(), moved = Vector3::Zero();
};

/// Mean motion of all blocks of the cube.
Mean mean_of_cube(const runs::BlocksModel& model) {
  const auto snapshot = model.simulation->snapshot();
  const auto& bodies = model.simulation->bodies();
  Mean mean;
  for (std::size_t body = 0; body < bodies.inertia.size(); ++body) {
    if (model.mesh.region[body] == 0) continue;
    const Real mass = bodies.inertia[body].mass;
    mean.mass += mass;
    mean.velocity += mass * snapshot.velocity[body];
    mean.moved += mass * (snapshot.pose[body].position - bodies.start[body]);
  }
  mean.velocity /= mean.mass;
  mean.moved /= mean.mass;
  return mean;
}

TEST(face_contacts, a_cube_without_friction_keeps_its_velocity_over_the_seams_of_a_floor) {
  auto model = started(sliding(2), cube_on_floor());
  Real sunk = 0, worst = 0;
  const Real energy = kinetic_at_start(model);
  for (int round = 0; round < 200; ++round) {
    run(model, 50);
    const Mean mean = mean_of_cube(model);
    sunk = std::min(sunk, mean.moved.z());
    ASSERT_NEAR(mean.velocity.x(), 2, 2e-6) << mean.moved.transpose();
    worst = std::max(worst, std::abs(model.simulation->energy_balance().residual()));
  }
  const Mean mean = mean_of_cube(model);
  EXPECT_NEAR(mean.moved.x(), 0.3, 1e-6);  // six elements of the floor
  EXPECT_LT(std::abs(mean.moved.y()), 1e-6);
  EXPECT_LT(worst, 1e-6 * energy);
  const Real weight = 2400 * gravity * cube_size;           // per area
  EXPECT_GT(sunk, -2.2 * weight / 2e9 - 2 * weight / 2e9);  // it swings about its rest, with what its joints give
}

TEST(face_contacts, friction_brakes_a_cube_as_coulomb_says) {
  auto blocks = sliding(0.5);
  blocks.contact.friction_coefficient = 0.3;
  blocks.contact.face_damping = 2e5;
  auto model = started(blocks, cube_on_floor());
  run(model, 6000);
  EXPECT_NEAR(mean_of_cube(model).velocity.x(), 0.5 - 0.3 * gravity * 0.09, 2e-3);
  run(model, 8000);  // it has come to rest
  const Mean at_rest = mean_of_cube(model);
  EXPECT_LT(at_rest.velocity.norm(), 1e-3);
  EXPECT_NEAR(at_rest.moved.x(), 0.25 / (2 * 0.3 * gravity), 1e-3);
  const auto balance = model.simulation->energy_balance();
  EXPECT_LT(std::abs(balance.residual()), 1e-3 * balance[EnergyKind::friction]);
}

/// Blocks that are near each other seen from the one and not from the other would begin and end a pair in the same step.
TEST(face_contacts, bodies_that_fly_together_keep_what_is_near) {
  auto blocks = sliding(2);
  blocks.gravity.acceleration = Vector3::Zero();
  blocks.constraints.clear();
  test::move(blocks, "floor", {2, 0, 0});
  geometry::TetraMesh mesh;
  test::add_box(mesh, {"floor", {0, 0, -0.1}, {4, 4, 4}, 0.025});
  test::add_box(mesh, {"cube", {0.03, 0.04, 1e-3}, {3, 3, 3}, 0.02});
  auto model = started(blocks, mesh);
  const Index near = model.contacts->pair_count();
  EXPECT_GT(near, 0);
  for (int round = 0; round < 20; ++round) {
    run(model, 100);
    EXPECT_NEAR(static_cast<Real>(model.contacts->pair_count()), static_cast<Real>(near), 3);
  }
  for (const Vector3& velocity : model.simulation->snapshot().velocity) EXPECT_LT((velocity - Vector3(2, 0, 0)).norm(), 1e-9);
}

TEST(face_contacts, the_surface_of_a_coupled_run_needs_spheres) {
  auto blocks = towards(Vector3::Zero(), 1e9);
  EXPECT_THROW(runs::build_blocks(blocks, blocks_apart(Vector3::Zero()), {.window = 1e-3}), UserError);
  blocks.contact.normal_stiffness = 1e6;
  EXPECT_NE(runs::build_blocks(blocks, blocks_apart(Vector3::Zero()), {.window = 1e-3}).surface, nullptr);
}

/// Seams within one body that holds together give no contact, however it is strained.
TEST(face_contacts, blocks_that_hold_together_around_an_edge_do_not_touch) {
  auto blocks = test::bar_case();
  touch_by_faces(blocks, 1e12);
  EXPECT_EQ(started(blocks, test::cube_bar(4, 0.1, 1)).contacts->pair_count(), 0);
}

/// A cube of six blocks around its diagonal: one open face leaves them in a chain, two set one of them free.
TEST(face_contacts, a_block_touches_those_around_an_edge_once_no_chain_of_joints_holds_it) {
  auto blocks = test::bar_case();
  touch_by_faces(blocks, 1e12);
  cases::Joint cut;
  cut.name = cut.surface = "cut";
  cut.bonded = false;
  blocks.joints.push_back(cut);
  geometry::TetraMesh cube = test::cube_bar(1, 0.1, 1);
  cube.surfaces.push_back({"cut", {{0, 6, 7}}});
  EXPECT_EQ(started(blocks, cube).contacts->pair_count(), 1);
  cube.surfaces.back().triangles.push_back({0, 4, 7});
  EXPECT_EQ(started(blocks, cube).contacts->pair_count(), 5);
}

}  // namespace
}  // namespace sazare::methods::blocks
