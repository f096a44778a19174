/// Stress that blocks carry from the beginning, through whole simulations.

#include <gtest/gtest.h>

#include <cmath>

#include "sazare/geometry/face_map.hpp"
#include "tests/support/blocks_scene.hpp"
#include "tests/support/box_of_blocks.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind, test::run;

constexpr Real density = 2500, youngs_modulus = 10e9, gravity = 9.8, size = 0.3;

/// A cube of 162 blocks on z = 0, its corners moved a little; its upper side is the surface "top", all others are "sides".
geometry::TetraMesh cube(Real askew = 0.01) {
  geometry::TetraMesh mesh;
  const auto move = [&](const Vector3& at) -> Vector3 {
    const auto inner = [](Real x) { return x > 0.05 && x < 0.25 ? 1.0 : 0.0; };
    return askew * Vector3(inner(at.x()) * std::sin(91 * at.y() + 40 * at.z()), inner(at.y()) * std::cos(77 * at.x()),
                           inner(at.z()) * std::sin(83 * at.x() + 50 * at.y()));
  };
  test::add_box(mesh, {"rock", Vector3::Zero(), {3, 3, 3}, size / 3}, move);
  mesh.surfaces = {{"sides", {}}, {"top", {}}};
  for (const geometry::OuterFace& outer : geometry::build_face_map(mesh).outer) {
    const bool is_top = std::ranges::all_of(outer.nodes, [&](Index node) { return mesh.nodes[at(node)].z() > 0.99 * size; });
    mesh.surfaces[is_top ? 1 : 0].triangles.push_back(outer.nodes);
  }
  return mesh;
}

cases::BlocksCase rock(Real poisson_ratio = 0.2) { return test::elastic_rock(density, youngs_modulus, poisson_ratio); }

Real fastest(const runs::BlocksModel& model) {
  Real speed = 0;
  for (const Vector3& velocity : model.simulation->snapshot().velocity) speed = std::max(speed, velocity.norm());
  return speed;
}

/// The velocity behind a wave of this stress in a bar.
Real wave_speed(Real stress) { return stress / (density * std::sqrt(youngs_modulus / density)); }

/// Places of joints are in single precision: so much moves what should be at rest.
Real rest_speed(Real stress) { return 1e-6 * wave_speed(stress); }

TEST(initial_stress, any_stress_stays_at_rest_between_boundaries_that_carry_it) {
  for (const cases::BoundaryKind kind : {cases::BoundaryKind::fixed, cases::BoundaryKind::absorbing}) {
    auto blocks = rock();
    blocks.time.levels = cases::Levels::uniform;
    blocks.initial_stress.normal = {-30e6, -10e6, 5e6};
    blocks.initial_stress.shear = {4e6, -3e6, 2e6};
    blocks.boundaries = {{"sides", kind}, {"top", kind}};
    auto model = runs::build_blocks(blocks, cube());
    model.simulation->start();
    run(model, 300);
    EXPECT_LT(fastest(model), rest_speed(30e6));
    EXPECT_EQ(model.joints->broken_count(), 0);
    EXPECT_LT(model.fit.start_balance.unbalanced.norm(), 1e-9 * model.fit.start_balance.largest);
    EXPECT_EQ(model.fit.start_balance.unloaded, 0);
  }
}

TEST(initial_stress, ground_under_its_own_weight_stays_at_rest_on_absorbing_boundaries) {
  for (const Real k0 : {0.0, 0.5, 1.5}) {
    auto blocks = rock();
    blocks.time.levels = cases::Levels::uniform;
    blocks.gravity.acceleration = {0, 0, -gravity};
    blocks.initial_stress.k0 = k0;
    blocks.initial_stress.datum = size;
    blocks.boundaries = {{"sides", cases::BoundaryKind::absorbing}};
    auto model = runs::build_blocks(blocks, cube());
    EXPECT_LT(model.fit.start_balance.unbalanced.norm(), 1e-9 * model.fit.start_balance.largest);
    EXPECT_LT(model.fit.start_balance.unloaded_stress, 1e-6);
    EXPECT_TRUE(model.fit.start_balance.is_in_equilibrium());
    blocks.initial_stress.datum = size - 0.1;
    EXPECT_NEAR(runs::build_blocks(blocks, cube()).fit.start_balance.above_datum, 0.1, 1e-12);
    blocks.initial_stress.datum = size;
    model.simulation->start();
    run(model, 300);
    EXPECT_LT(fastest(model), rest_speed(density * gravity * size)) << k0;
  }
}

/// Links of different levels give their impulses at different times, so that a body between them sways about its place.
TEST(initial_stress, bodies_of_mixed_levels_are_moved_little) {
  auto blocks = rock();
  blocks.initial_stress.normal = {-30e6, -10e6, 5e6};
  blocks.boundaries = {{"sides", cases::BoundaryKind::absorbing}, {"top", cases::BoundaryKind::absorbing}};
  auto model = runs::build_blocks(blocks, cube());
  model.simulation->start();
  EXPECT_GT(model.simulation->levels().finest(), 0);
  Real largest = 0;
  for (int step = 0; step < 300; ++step) {
    run(model, 1);
    largest = std::max(largest, fastest(model));
  }
  EXPECT_LT(largest, 0.01 * wave_speed(30e6));
  EXPECT_LT(fastest(model), 0.1 * largest);
}

TEST(initial_stress, frictionless_boundaries_carry_its_normal_part_alone) {
  auto blocks = rock();
  blocks.initial_stress.normal = {-30e6, -10e6, -20e6};
  blocks.boundaries = {{"sides", cases::BoundaryKind::frictionless}, {"top", cases::BoundaryKind::frictionless}};
  auto model = runs::build_blocks(blocks, cube());
  model.simulation->start();
  run(model, 300);
  EXPECT_LT(fastest(model), rest_speed(30e6));
  blocks.initial_stress.shear = {1e6, 0, 0};
  auto sheared = runs::build_blocks(blocks, cube());
  sheared.simulation->start();
  run(sheared, 20);
  EXPECT_GT(fastest(sheared), 1e3 * rest_speed(30e6));
}

constexpr Real bar_stress = 10e6, bar_length = 0.8, bar_section = 0.01;

/// A bar of rock that is free, and what has become of it after ten swings.
struct Swung {
  Real mean = 0, largest = 0;  ///< strains along it
  Real released = 0;           ///< the most energy that its springs have given away [J]
  Real unbalanced = 0;         ///< largest residual of the energy balance [J]
};

Swung swing(cases::BlocksCase blocks) {
  blocks.initial_velocities.clear();
  blocks.materials.front() = {"concrete", {"head", "rest"}, density, youngs_modulus, 0};
  blocks.joints.front().normal_stiffness = blocks.joints.front().shear_stiffness = std::nullopt;
  geometry::TetraMesh mesh = test::cube_bar(8, 0.1, 1);
  mesh.surfaces.push_back({"begin", {{0, 3, 2}, {0, 1, 3}}});
  auto model = runs::build_blocks(blocks, mesh);
  model.simulation->start();
  Swung swung;
  constexpr int steps = 8000;
  for (int step = 0; step < steps; ++step) {
    run(model, 1);
    const auto snapshot = model.simulation->snapshot();
    const auto& start = model.simulation->bodies().start;
    Real moment = 0, square = 0;
    for (std::size_t body = 0; body < start.size(); ++body) {
      const Real from_middle = start[body].x() - bar_length / 2;
      moment += from_middle * (snapshot.pose[body].position.x() - start[body].x());
      square += from_middle * from_middle;
    }
    swung.largest = std::max(swung.largest, moment / square);
    swung.mean += moment / square / steps;
    const auto balance = model.simulation->energy_balance();
    swung.released = std::max(swung.released, -balance[EnergyKind::elastic]);
    swung.unbalanced = std::max(swung.unbalanced, std::abs(balance.residual()));
  }
  return swung;
}

/// What was compressed springs back to its length without stress, with all that it had stored: by as much as a pressure of this
/// size compresses it.
TEST(initial_stress, a_bar_that_is_set_free_springs_back_to_its_length) {
  auto blocks = test::bar_case();
  blocks.initial_stress.normal = {-bar_stress, 0, 0};
  const Swung free = swing(blocks);
  const Real stored = bar_stress * bar_stress / (2 * youngs_modulus) * bar_length * bar_section;
  EXPECT_NEAR(free.released, stored, 0.1 * stored);  // cubes of six blocks are 7 % softer than rock along their edges
  EXPECT_LT(free.unbalanced, 1e-3 * free.released);
  EXPECT_GT(free.largest, 1.5 * free.mean);

  auto pressed = test::bar_case();
  for (const std::string end : {"begin", "end"}) {
    cases::Blast load;
    load.name = load.surface = end;
    load.pressure = cases::PressureTable{"", {0, 1}, {bar_stress, bar_stress}};
    pressed.blasts.push_back(load);
  }
  EXPECT_NEAR(free.mean, -swing(pressed).mean, 0.01 * free.mean);
}

TEST(initial_stress, beyond_the_strength_is_counted_by_joint) {
  auto blocks = rock();
  blocks.joints.front().tensile_strength = 4e6;
  blocks.joints.front().fracture_energy = 1e4;
  blocks.initial_stress.normal = {5e6, 0, 0};
  blocks.boundaries = {{"sides", cases::BoundaryKind::fixed}, {"top", cases::BoundaryKind::fixed}};
  const auto model = runs::build_blocks(blocks, cube());
  EXPECT_GT(model.fit.overstressed.front().faces, 0);
  EXPECT_NEAR(model.fit.overstressed.front().worst, 5.0 / 4, 0.01);
  blocks.initial_stress.normal = {3e6, 0, 0};
  EXPECT_EQ(runs::build_blocks(blocks, cube()).fit.overstressed.front().faces, 0);
}

TEST(initial_stress, without_boundaries_to_carry_it_leaves_a_resultant) {
  auto blocks = rock();
  blocks.initial_stress.normal = {0, 0, -2e6};
  blocks.boundaries = {{"sides", cases::BoundaryKind::fixed}};
  const auto model = runs::build_blocks(blocks, cube());
  EXPECT_NEAR(model.fit.start_balance.lost.z(), -2e6 * size * size, 1e-6 * 2e6 * size * size);
  EXPECT_LT(model.fit.start_balance.unbalanced.norm(), 1e-9 * model.fit.start_balance.largest);
  EXPECT_FALSE(model.fit.start_balance.is_in_equilibrium());
  EXPECT_EQ(model.fit.start_balance.unloaded, 18);
  EXPECT_NEAR(model.fit.start_balance.unloaded_stress, 2e6, 1e-6 * 2e6);
}

TEST(initial_stress, is_carried_by_a_pressure_that_is_there_from_the_beginning) {
  auto blocks = rock();
  blocks.time.levels = cases::Levels::uniform;
  blocks.initial_stress.normal = {-1e6, -1e6, -2e6};
  blocks.boundaries = {{"sides", cases::BoundaryKind::fixed}};
  blocks.blasts = {{.name = "jack", .surface = "top", .pressure = cases::PressureTable{"", {0, 1}, {2e6, 2e6}}}};
  auto model = runs::build_blocks(blocks, cube());
  EXPECT_EQ(model.fit.start_balance.unloaded, 0);
  EXPECT_TRUE(model.fit.start_balance.is_in_equilibrium());
  model.simulation->start();
  run(model, 300);
  EXPECT_LT(fastest(model), rest_speed(2e6));
  blocks.blasts.front().delay = 1e-3;
  EXPECT_EQ(runs::build_blocks(blocks, cube()).fit.start_balance.unloaded, 18);
}

/// However large the stress is: a stress that does not grow with depth does not carry the weight.
TEST(initial_stress, that_does_not_grow_with_depth_is_not_in_equilibrium_with_the_weight) {
  auto blocks = rock();
  blocks.gravity.acceleration = {0, 0, -gravity};
  blocks.initial_stress.normal = {-1e8, -1e8, -1e8};
  blocks.boundaries = {{"sides", cases::BoundaryKind::absorbing}, {"top", cases::BoundaryKind::absorbing}};
  EXPECT_FALSE(runs::build_blocks(blocks, cube()).fit.start_balance.is_in_equilibrium());
  blocks.initial_stress.normal_per_depth = {0, 0, -density * gravity};
  EXPECT_TRUE(runs::build_blocks(blocks, cube()).fit.start_balance.is_in_equilibrium());
}

TEST(initial_stress, that_is_not_carried_by_frictionless_faces_is_counted) {
  auto blocks = rock();
  blocks.initial_stress.shear = {1e6, 0, 0};
  blocks.boundaries = {{"sides", cases::BoundaryKind::frictionless}, {"top", cases::BoundaryKind::frictionless}};
  const auto model = runs::build_blocks(blocks, cube());
  EXPECT_EQ(model.fit.start_balance.unloaded, 72);  // those whose normals lie along x or y
  EXPECT_NEAR(model.fit.start_balance.unloaded_stress, 1e6, 1);
}

}  // namespace
}  // namespace sazare::methods::blocks
