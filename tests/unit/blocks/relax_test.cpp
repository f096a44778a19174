/// Blocks that come to equilibrium before time begins, through whole simulations.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

#include "sazare/core/error.hpp"
#include "sazare/geometry/face_map.hpp"
#include "sazare/methods/blocks/run/joints/element_stress.hpp"
#include "sazare/methods/blocks/run/start/relax.hpp"
#include "sazare/methods/blocks/run/state_hash.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/box_of_blocks.hpp"
#include "tests/support/deformable_blocks.hpp"

namespace sazare::methods::blocks {
namespace {

using cases::BoundaryKind, test::run;

constexpr Real density = 2500, youngs_modulus = 10e9, gravity = 9.8, size = 0.25;  // size of a cube [m]

/// A box of cubes on z = 0. Its sides are the surfaces "base", "top" and "sides".
geometry::TetraMesh box(std::array<int, 3> cubes) {
  geometry::TetraMesh mesh;
  test::add_box(mesh, {"rock", Vector3::Zero(), cubes, size});
  mesh.surfaces = {{"base", {}}, {"top", {}}, {"sides", {}}};
  for (const geometry::OuterFace& outer : geometry::build_face_map(mesh).outer) {
    const auto all_at = [&](Real z) {
      return std::ranges::all_of(outer.nodes, [&](Index node) { return std::abs(mesh.nodes[at(node)].z() - z) < 1e-9; });
    };
    mesh.surfaces[all_at(0) ? 0 : all_at(cubes[2] * size) ? 1 : 2].triangles.push_back(outer.nodes);
  }
  return mesh;
}

cases::BlocksCase rock(bool deformable, Real poisson_ratio = 0) {
  auto blocks = test::elastic_rock(density, youngs_modulus, poisson_ratio);
  if (deformable) blocks.materials[0].deformable = true;
  return blocks;
}

cases::BlocksCase heavy_rock(bool deformable, std::vector<cases::Boundary> boundaries, Real poisson_ratio = 0) {
  auto blocks = rock(deformable, poisson_ratio);
  blocks.gravity.acceleration = {0, 0, -gravity};
  blocks.gravity.settle = true;
  blocks.boundaries = std::move(boundaries);
  return blocks;
}

runs::RunOptions quiet() {
  runs::RunOptions options;
  options.quiet = true;
  return options;
}

runs::BlocksModel relaxed(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh) {
  auto model = runs::build_blocks(blocks, mesh);
  EXPECT_TRUE(runs::relax(blocks, model, quiet()));
  return model;
}

Real fastest(const runs::BlocksModel& model) {
  Real speed = 0;
  for (const Vector3& velocity : model.simulation->snapshot().velocity) speed = std::max(speed, velocity.norm());
  return speed;
}

Real mass_of(const runs::BlocksModel& model) {
  Real mass = 0;
  for (const auto& inertia : model.simulation->bodies().inertia) mass += inertia.mass;
  return mass;
}

Real wave_velocity() { return std::sqrt(youngs_modulus / density); }

std::vector<Vector3> boundary_forces(const runs::BlocksModel& model) {
  const auto now = model.simulation->snapshot();
  return model.boundaries->forces(model.simulation->now().seconds(), [&](Index body) -> BodyMotion {
    const auto strain = now.strain.empty() ? state::StrainNow{} : now.strain[at(body)];
    return {now.pose[at(body)], now.velocity[at(body)], Vector3::Zero(), strain.strain, strain.rate};
  });
}

/// What a column yields under its weight: s = rho g (H - z), u = rho g (H z - z^2/2) / E.
void expect_column(const runs::BlocksModel& model, int cubes, Real tolerance) {
  const Real height = cubes * size, top = density * gravity * height * height / (2 * youngs_modulus);
  const auto& bodies = model.simulation->bodies();
  const auto stress = runs::element_stresses(model, model.simulation->snapshot());
  std::vector<Real> layer(at(cubes), 0);
  for (std::size_t element = 0; element < model.equilibrium.size(); ++element) {
    const Real z = bodies.start[element].z();
    const Real expected = -density * gravity * (height * z - 0.5 * z * z) / youngs_modulus;
    EXPECT_NEAR(model.equilibrium[element].z() - z, expected, tolerance * top);
    layer[static_cast<std::size_t>(z / size)] += stress.normal[element].z() * bodies.inertia[element].mass;
  }
  const Real mass_of_layer = mass_of(model) / cubes;
  for (int n = 1; n < cubes; ++n)  // the stress of an element is that of its joints, not of boundaries
    EXPECT_NEAR(layer[at(n)] / mass_of_layer, -density * gravity * (height - (n + 0.5) * size),
                0.02 * density * gravity * height);
}

TEST(relax, a_column_under_its_weight_settles_as_theory_says_and_rests) {
  constexpr int cubes = 8;
  for (const bool deformable : {false, true}) {
    auto blocks = heavy_rock(deformable, {{"base", BoundaryKind::fixed}});
    blocks.time.levels = cases::Levels::uniform;
    auto model = relaxed(blocks, box({1, 1, cubes}));
    EXPECT_EQ(model.simulation->now().seconds(), 0);
    EXPECT_LT((boundary_forces(model)[0] - Vector3(0, 0, gravity * mass_of(model))).norm(), 1e-4 * gravity * mass_of(model));
    expect_column(model, cubes, deformable ? 0.02 : 0.08);
    run(model, 300);
    EXPECT_LT(fastest(model), 1e-9 * wave_velocity());
    // Without settling the top reaches about g H / c.
    EXPECT_LT(fastest(model), 1e-4 * gravity * cubes * size / wave_velocity());
  }
}

TEST(relax, displacements_velocities_and_energies_count_from_the_equilibrium) {
  auto blocks = heavy_rock(true, {{"base", BoundaryKind::fixed}});
  const Vector3 velocity(0.1, -0.2, 0.3);
  blocks.initial_velocities = {{{"rock"}, velocity}};
  const auto model = relaxed(blocks, box({2, 2, 3}));
  const auto now = model.simulation->snapshot();
  Real settlement = 0;
  for (std::size_t element = 0; element < now.pose.size(); ++element) {
    EXPECT_LT((now.pose[element].position - model.places_at_start()[element]).norm(), 1e-15);
    EXPECT_LT((now.velocity[element] - velocity).norm(), 1e-12);
    settlement = std::max(settlement, (model.equilibrium[element] - model.simulation->bodies().start[element]).norm());
  }
  EXPECT_GT(settlement, 1e-7);
  for (const Real joules : model.simulation->energy_balance().joules) EXPECT_LT(std::abs(joules), 1e-12);
}

TEST(relax, absorbing_boundaries_are_fixed_and_then_carry_what_they_carried) {
  for (const bool deformable : {false, true}) {
    const auto mesh = box({3, 3, 3});
    const auto fixed =
        relaxed(heavy_rock(deformable, {{"base", BoundaryKind::fixed}, {"sides", BoundaryKind::fixed}}, 0.2), mesh);
    auto absorbing =
        relaxed(heavy_rock(deformable, {{"base", BoundaryKind::absorbing}, {"sides", BoundaryKind::absorbing}}, 0.2), mesh);
    const auto forces = boundary_forces(absorbing), held = boundary_forces(fixed);
    const Real weight = gravity * mass_of(fixed);
    // The springs of fixed ground are taken out of the stiffness of deformable elements, those that hold for a while are not.
    if (!deformable) {
      EXPECT_EQ(absorbing.equilibrium, fixed.equilibrium);
    }
    for (std::size_t n = 0; n < forces.size(); ++n) EXPECT_LT((forces[n] - held[n]).norm(), (deformable ? 0.02 : 1e-6) * weight);
    EXPECT_NEAR((forces[0] + forces[1]).z(), weight, 1e-4 * weight);
    run(absorbing, 300);
    EXPECT_LT(fastest(absorbing), 1e-9 * wave_velocity());
  }
}

TEST(relax, an_initial_stress_that_nothing_carries_is_gone) {
  // The box rises by s/E of its height. Elements keep a stress in equilibrium with itself, whose mean is 0.
  constexpr Real stress = 10e6;
  auto blocks = rock(true, 0.2);
  blocks.initial_stress.normal = {0, 0, -stress};
  blocks.initial_stress.settle = true;
  blocks.boundaries = {{"base", BoundaryKind::frictionless}};
  auto model = relaxed(blocks, box({2, 2, 4}));
  Vector3 mean = Vector3::Zero();
  for (const Vector3& normal : runs::element_stresses(model, model.simulation->snapshot()).normal) mean += normal;
  EXPECT_LT(mean.norm() / static_cast<Real>(model.equilibrium.size()), 1e-4 * stress);
  const auto& bodies = model.simulation->bodies();
  Real risen = 0, expected = 0;
  for (std::size_t element = 0; element < model.equilibrium.size(); ++element) {
    risen += model.equilibrium[element].z() - bodies.start[element].z();
    expected += stress / youngs_modulus * bodies.start[element].z();
  }
  EXPECT_NEAR(risen / expected, 1, 0.02);
  run(model, 100);
  EXPECT_LT(fastest(model), 1e-4 * stress / (density * wave_velocity()));
}

TEST(relax, does_not_depend_on_the_number_of_threads) {
  const auto blocks = heavy_rock(false, {{"base", BoundaryKind::absorbing}}, 0.2);
  const auto mesh = box({6, 6, 5});
  const auto hash_on = [&](int threads) {
    parallel::set_threads(threads);
    auto model = relaxed(blocks, mesh);
    run(model, 5);
    parallel::set_threads(0);
    return runs::state_hash(model);
  };
  const auto alone = hash_on(1);
  EXPECT_EQ(hash_on(2), alone);
  EXPECT_EQ(hash_on(4), alone);
}

TEST(relax, the_energy_of_a_blast_from_the_equilibrium_is_balanced) {
  for (const bool deformable : {false, true}) {
    auto blocks = heavy_rock(deformable, {{"base", BoundaryKind::absorbing}}, 0.2);
    cases::Blast blast;
    blast.name = blast.surface = "top";
    blast.pressure = cases::PressurePulse{1e6, 1e-4, 3};
    blocks.blasts = {blast};
    blocks.time.stability_fraction = 0.25;
    auto model = relaxed(blocks, box({3, 3, 4}));
    run(model, 800);
    const terms::EnergyBalance balance = model.simulation->energy_balance();
    EXPECT_GT(balance[terms::EnergyKind::work], 0.1);
    EXPECT_GT(balance[terms::EnergyKind::boundary], 0.01 * balance[terms::EnergyKind::work]);
    EXPECT_LT(std::abs(balance.residual()), 1e-4 * balance[terms::EnergyKind::work]);
  }
}

TEST(relax, loads_act_from_the_beginning_of_time_on) {
  // A table that stands at its pressure before and after 0 would press while the equilibrium was sought.
  auto blocks = heavy_rock(true, {{"base", BoundaryKind::fixed}});
  const auto without = relaxed(blocks, box({2, 2, 2}));
  cases::Blast blast;
  blast.name = blast.surface = "top";
  blast.pressure = cases::PressureTable{"", {0, 1}, {1e6, 1e6}};
  blocks.blasts = {blast};
  auto with = relaxed(blocks, box({2, 2, 2}));
  EXPECT_EQ(with.equilibrium, without.equilibrium);
  run(with, 5);
  EXPECT_GT(fastest(with), 1e-3);
}

TEST(relax, joints_that_cannot_carry_the_weight_break) {
  // A beam of four cubes that hangs by its end: rho g L^2/2 over h/6 is the stress in its root.
  geometry::TetraMesh mesh = box({4, 1, 1});
  for (auto& surface : mesh.surfaces) surface.triangles.clear();
  for (const geometry::OuterFace& outer : geometry::build_face_map(mesh).outer)
    if (std::ranges::all_of(outer.nodes, [&](Index node) { return mesh.nodes[at(node)].x() < 1e-9; }))
      mesh.surfaces[0].triangles.push_back(outer.nodes);
  auto blocks = heavy_rock(false, {{"base", BoundaryKind::fixed}});
  EXPECT_EQ(relaxed(blocks, mesh).joints->broken_count(), 0);
  blocks.joints[0].tensile_strength = blocks.joints[0].cohesion = 5e3;
  blocks.joints[0].fracture_energy = 0.01;
  auto model = runs::build_blocks(blocks, mesh);
  try {
    runs::relax(blocks, model, quiet());
    FAIL();
  } catch (const PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("moved away while the equilibrium was sought"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("nothing holds"), std::string::npos);
  }
}

TEST(relax, a_body_that_nothing_holds_is_refused) {
  auto blocks = heavy_rock(true, {{"sides", BoundaryKind::frictionless}});
  auto model = runs::build_blocks(blocks, box({1, 1, 1}));
  try {
    runs::relax(blocks, model, quiet());
    FAIL();
  } catch (const PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("moved away while the equilibrium was sought"), std::string::npos) << error.what();
  }
}

TEST(relax, ends_when_it_is_asked_to_stop) {
  const auto blocks = heavy_rock(true, {{"base", BoundaryKind::fixed}});
  auto model = runs::build_blocks(blocks, box({1, 1, 4}));
  const std::atomic<bool> stop = true;
  runs::RunOptions options = quiet();
  options.stop = &stop;
  EXPECT_FALSE(runs::relax(blocks, model, options));
  EXPECT_TRUE(model.equilibrium.empty());
}

}  // namespace
}  // namespace sazare::methods::blocks
