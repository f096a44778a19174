/// Blocks in water: they float, heave, sink and rest as they must.

#include "sazare/methods/blocks/water/water_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/blocks_scene.hpp"
#include "tests/support/box_of_blocks.hpp"
#include "tests/support/deformable_blocks.hpp"

namespace sazare::methods::blocks {
namespace {

constexpr Real gravity = 9.81, water_density = 1000;

/// Rock in water whose surface is at z = 0; nothing drags it unless it is asked to.
cases::BlocksCase in_water(Real density, bool bonded = true) {
  cases::BlocksCase blocks = test::elastic_rock(density, 1e9, 0.2);
  blocks.joints.front().bonded = bonded;
  blocks.contact.normal_stiffness = 1e6;
  blocks.time.history_interval = 1;
  blocks.gravity.acceleration = {0, 0, -gravity};
  blocks.water.level = 0;
  blocks.water.drag_coefficient = 0;
  return blocks;
}

/// A cube of six blocks with its lowest corner at a depth.
geometry::TetraMesh cube(Real depth, Real size = 1) {
  geometry::TetraMesh mesh;
  test::add_box(mesh, {.region = "rock", .corner = {0.2, -0.3, -depth}, .cubes = {1, 1, 1}, .size = size});
  return mesh;
}

/// One element, its base level.
geometry::TetraMesh element(Real depth) {
  geometry::TetraMesh mesh;
  mesh.nodes = {{0, 0, -depth}, {1, 0, -depth}, {0, 1, -depth}, {0, 0, 1 - depth}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  mesh.region = {0};
  mesh.region_names = {"rock"};
  return mesh;
}

/// Height and velocity of the centre of mass, and the largest speed.
struct Whole {
  Real height = 0, velocity = 0, fastest = 0;
};

Whole look_at(const runs::BlocksModel& model) {
  const auto now = model.simulation->snapshot();
  Whole whole;
  Real mass = 0;
  for (std::size_t body = 0; body < now.pose.size(); ++body) {
    const Real own = model.simulation->bodies().inertia[body].mass;
    mass += own;
    whole.height += own * now.pose[body].position.z();
    whole.velocity += own * now.velocity[body].z();
    whole.fastest = std::max(whole.fastest, now.velocity[body].norm());
  }
  whole.height /= mass;
  whole.velocity /= mass;
  return whole;
}

TEST(water_loads, lift_what_is_under_water_by_its_weight_of_water) {
  for (const bool deformable : {false, true}) {
    cases::BlocksCase blocks = in_water(2600);
    if (deformable) blocks = test::deformable(blocks, 1e7);
    auto model = runs::build_blocks(blocks, cube(0.35));
    model.simulation->start();
    Vector3 lift = Vector3::Zero();
    for (Index body = 0; body < 6; ++body) lift += model.water->force(body);
    EXPECT_LT((lift - water_density * gravity * 0.35 * Vector3::UnitZ()).norm(), 1e-9);
  }
}

TEST(water_loads, a_floating_block_stays_at_its_draught) {
  cases::BlocksCase blocks = in_water(600);
  blocks.constraints = {{{"rock"}, {false, false, false}, {true, true, true}}};
  blocks.time.base_step = 1e-3;
  blocks.time.limiter = cases::Limiter::none;
  const Real draught = 1 - std::cbrt(0.4);  // of a pyramid that is 1 m high
  auto model = runs::build_blocks(blocks, element(draught));
  model.simulation->start();
  const Real height = look_at(model).height;
  test::run(model, 2000);
  EXPECT_LT(look_at(model).fastest, 1e-13);
  EXPECT_NEAR(look_at(model).height, height, 1e-13);
}

/// A cube of this density floats upright: lighter ones fall over.
constexpr Real upright = 900;

TEST(water_loads, a_block_that_floats_upright_stays) {
  auto model = runs::build_blocks(in_water(upright), cube(0.9));
  model.simulation->start();
  const Real strained = 2 * water_density * gravity / 1e9;  // by pressure and weight, which come at once
  Real fastest = 0;
  while (model.simulation->now().seconds() < 1) {
    test::run(model, 10);
    fastest = std::max(fastest, std::abs(look_at(model).velocity));
    EXPECT_NEAR(look_at(model).height, -0.4, strained);
  }
  EXPECT_LT(fastest, 4 * strained);
}

/// A heaving block is a mass on the spring rho g A, as long as the surface cuts its sides.
TEST(water_loads, a_floating_block_heaves_with_its_period) {
  const Real away = 0.05, rate = std::sqrt(gravity / 0.9);
  auto model = runs::build_blocks(in_water(upright), cube(0.9 + away));
  model.simulation->start();
  Real worst = 0, time = 0;
  while (time < 4 * std::numbers::pi / rate) {
    test::run(model, 10);
    time = model.simulation->now().seconds();
    worst = std::max(worst, std::abs(look_at(model).height + 0.4 + away * std::cos(rate * time)));
  }
  EXPECT_LT(worst, 1e-3 * away);
  const auto balance = model.simulation->energy_balance();
  const Real stored = 0.5 * water_density * gravity * away * away;
  EXPECT_LT(std::abs(balance[terms::EnergyKind::work]), 1e-2 * stored);  // two periods later it is where it began
  EXPECT_LT(std::abs(balance.residual()), 1e-3 * stored);
}

TEST(water_loads, what_is_as_heavy_as_water_rests_though_it_is_broken) {
  for (const Real depth : {2.0, 10.0}) {
    cases::BlocksCase blocks = in_water(water_density, false);
    blocks.time.base_step = 1e-3;
    auto model = runs::build_blocks(blocks, cube(depth));
    model.simulation->start();
    test::run(model, 500);
    EXPECT_LT(look_at(model).fastest, 1e-12);
  }
}

TEST(water_loads, an_element_that_sinks_reaches_its_terminal_velocity) {
  cases::BlocksCase blocks = in_water(2600);
  blocks.water.drag_coefficient = 1.2;
  blocks.constraints = {{{"rock"}, {false, false, false}, {true, true, true}}};
  blocks.time.base_step = 1e-3;
  blocks.time.limiter = cases::Limiter::none;
  auto model = runs::build_blocks(blocks, element(3));
  model.simulation->start();
  const Real volume = 1.0 / 6, area = 0.5, mass = 2600 * volume;
  const Real weight = (2600 - water_density) * volume * gravity;
  const Real terminal = std::sqrt(weight / (0.5 * water_density * 1.2 * area)), scale = mass * terminal / weight;
  for (int n = 0; n < 20; ++n) {
    test::run(model, 100);
    const Real expected = -terminal * std::tanh(model.simulation->now().seconds() / scale);
    EXPECT_NEAR(look_at(model).velocity, expected, 1e-5 * terminal);
  }
  EXPECT_NEAR(look_at(model).velocity, -terminal, 1e-3 * terminal);
  const auto balance = model.simulation->energy_balance();
  EXPECT_LT(std::abs(balance.residual()), 1e-5 * balance[terms::EnergyKind::kinetic]);
}

/// Nothing else limits the step of a single element: it must not be that of the rows.
TEST(water_loads, drag_limits_the_step_of_an_element_alone) {
  for (const Real current : {0.0, 5.0}) {
    cases::BlocksCase blocks = in_water(2600);
    blocks.water.drag_coefficient = 1.2;
    blocks.water.current = {current, 0, 0};
    blocks.constraints = {{{"rock"}, {false, true, false}, {true, true, true}}};
    auto model = runs::build_blocks(blocks, element(3));
    model.simulation->start();
    test::run(model, static_cast<int>(std::ceil(4 / model.simulation->levels().step(0))));
    const auto balance = model.simulation->energy_balance();
    EXPECT_LT(std::abs(balance.residual()), 0.02 * balance[terms::EnergyKind::kinetic]) << current;
    EXPECT_LT(look_at(model).fastest, 10);
  }
}

TEST(water_loads, a_current_meets_the_faces_that_look_against_it) {
  cases::BlocksCase blocks = in_water(2600);
  blocks.water.drag_coefficient = 1;
  blocks.water.current = {2, 0, 0};
  auto model = runs::build_blocks(blocks, cube(0.5));
  model.simulation->start();
  Vector3 force = Vector3::Zero();
  for (Index body = 0; body < 6; ++body) force += model.water->force(body);
  EXPECT_NEAR(force.x(), 0.5 * water_density * 4 * 0.5, 1e-9);  // on half a square metre; what is inside has none
  EXPECT_NEAR(force.y(), 0, 1e-9);
}

TEST(water_loads, faces_between_elements_are_washed_once_they_are_apart) {
  cases::BlocksCase blocks = in_water(2600, false);
  blocks.initial_velocities = {{{"left"}, {-0.5, 0, 0}}};
  blocks.materials = {{"left", {"left"}, water_density}, {"right", {"right"}, water_density}};
  blocks.joints.front().between = {"left", "right"};
  blocks.gravity.acceleration = {0, 0, -gravity};
  blocks.water.level = 10;
  blocks.time.base_step = 1e-3;
  auto model = runs::build_blocks(blocks, test::two_blocks());
  model.simulation->start();
  const Real width = std::sqrt(std::sqrt(3.0) / 4 * 0.01);  // of the face between them: 0.066 m
  const auto washed = [&] {
    int count = 0;
    for (std::size_t face = 0; face < model.water->faces().size(); ++face) count += model.water->is_washed(face) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(washed(), 6);
  test::run(model, static_cast<int>(0.9 * width / 0.5 / 1e-3));
  EXPECT_EQ(washed(), 6);
  test::run(model, static_cast<int>(0.2 * width / 0.5 / 1e-3));
  EXPECT_EQ(washed(), 8);
}

}  // namespace
}  // namespace sazare::methods::blocks
