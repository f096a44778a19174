/// Ground that moves beneath blocks: forces, waves, and the work that it does.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/cases/motion_of_case.hpp"
#include "sazare/geometry/face_map.hpp"
#include "sazare/levels/motion/kick.hpp"
#include "tests/support/blocks_scene.hpp"
#include "tests/support/box_of_blocks.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind, test::run;

constexpr Real density = 2500, youngs_modulus = 10e9, poisson_ratio = 0.2, side = 0.1;

cases::Motion motion(const std::string& name, laws::MotionQuantity quantity, std::vector<Real> values, Real step) {
  cases::Motion made;
  made.name = name;
  made.type = cases::MotionShape::record;
  made.quantity = quantity;
  made.record = laws::Record::make(step, std::move(values));
  return made;
}

/// A column of cubes of six blocks along z, between the surfaces "bottom" and "top"; its nodes within are moved a little.
geometry::TetraMesh column(int high, int across = 2) {
  geometry::TetraMesh mesh;
  const Real size = side / across, height = high * size;
  const auto inner = [&](Real x, Real length) { return x > 0.5 * size && x < length - 0.5 * size ? 0.15 * size : 0; };
  const auto move = [&](const Vector3& at) -> Vector3 {
    const Vector3 n = at / size;
    return {inner(at.x(), side) * std::sin(7 * n.y() + 5 * n.z()), inner(at.y(), side) * std::cos(6 * n.x() + 4 * n.z()),
            inner(at.z(), height) * std::sin(8 * n.x() + 3 * n.y())};
  };
  test::add_box(mesh, {"rock", Vector3::Zero(), {across, across, high}, size}, move);
  mesh.surfaces = {{"bottom", {}}, {"top", {}}};
  for (const geometry::OuterFace& outer : geometry::build_face_map(mesh).outer)
    for (std::size_t end = 0; end < 2; ++end) {
      const Real level = end == 0 ? 0 : height;
      if (std::ranges::all_of(outer.nodes, [&](Index node) { return std::abs(mesh.nodes[at(node)].z() - level) < 1e-9; }))
        mesh.surfaces[end].triangles.push_back(outer.nodes);
    }
  return mesh;
}

cases::BlocksCase rock() { return test::elastic_rock(density, youngs_modulus, poisson_ratio); }

cases::Boundary moving(const std::string& surface, cases::BoundaryKind kind, const std::array<std::string, 3>& motion) {
  cases::Boundary boundary{surface, kind};
  boundary.motion = motion;
  return boundary;
}

std::vector<Vector3> forces_of(const runs::BlocksModel& model) {
  const auto now = model.simulation->snapshot();
  const auto& bodies = model.simulation->bodies();
  return model.boundaries->forces(model.simulation->now().seconds(), [&](Index body) -> BodyMotion {
    const auto& pose = now.pose[at(body)];
    return {pose, now.velocity[at(body)],
            motion::spin_of(pose.rotation, bodies.inertia[at(body)], bodies.locks[at(body)], now.angular_momentum[at(body)])};
  });
}

void run_until(runs::BlocksModel& model, Real time) {
  model.simulation->start();
  while (model.simulation->now().seconds() < time) model.simulation->advance();
}

/// The base of a column is shaken along all axes; joints have dashpots.
runs::BlocksModel shaken(Real stability_fraction, Real damping_ratio) {
  auto blocks = rock();
  blocks.joints.front().damping_ratio = damping_ratio;
  blocks.time.stability_fraction = stability_fraction;
  cases::Motion sine;
  sine.name = "sine";
  sine.type = cases::MotionShape::sine;
  sine.amplitude = 2e4;
  sine.frequency = 2000;
  blocks.motions = {sine};
  blocks.boundaries = {moving("bottom", cases::BoundaryKind::prescribed, {"sine", "sine", "sine"})};
  auto model = runs::build_blocks(blocks, column(6));
  run_until(model, 2e-3);
  return model;
}

TEST(moving_ground, does_the_work_that_the_blocks_take_up) {
  for (const Real damping_ratio : {0.0, 0.3}) {
    const auto coarse = shaken(0.5, damping_ratio).simulation->energy_balance();
    const auto fine = shaken(0.25, damping_ratio).simulation->energy_balance();
    const Real work = coarse[EnergyKind::work];
    EXPECT_GT(work, 10);
    EXPECT_NEAR(fine[EnergyKind::work], work, 0.02 * work);
    EXPECT_LT(std::abs(coarse.residual()), 2e-3 * work);
    EXPECT_LT(std::abs(fine.residual()), 5e-4 * work);
    EXPECT_EQ(fine[EnergyKind::boundary] > 0, damping_ratio > 0);
  }
}

/// Modulus of a column that a slowly growing pressure has compressed, by the work of the pressure [Pa]. The joints of this
/// regular mesh make it some 13 % larger than Young's modulus.
Real modulus_under_pressure() {
  auto blocks = rock();
  blocks.joints.front().damping_ratio = 0.5;
  const Real pressure = 1e6, height = 4 * side / 2;
  cases::Blast load;
  load.name = load.surface = "top";
  load.pressure = cases::PressureTable{{}, {0, 4e-3}, {0, pressure}};
  blocks.blasts = {load};
  blocks.boundaries = {{"bottom", cases::BoundaryKind::frictionless}};
  auto model = runs::build_blocks(blocks, column(4));
  run_until(model, 4e-3);
  const Real reached = pressure * model.simulation->now().seconds() / 4e-3;
  const Real shortening = 2 * model.simulation->energy_balance()[EnergyKind::work] / (reached * side * side);
  return reached / (shortening / height);
}

TEST(moving_ground, at_constant_velocity_sends_the_wave_of_a_bar_along) {
  auto blocks = rock();
  const Real velocity = 0.1, speed = std::sqrt(modulus_under_pressure() / density), length = 60 * side / 2;
  blocks.motions = {motion("push", laws::MotionQuantity::velocity, std::vector<Real>(30, velocity), 1e-4)};
  blocks.motions.front().record.value.front() = 0;
  blocks.motions.front().record.integrate();
  blocks.boundaries = {moving("bottom", cases::BoundaryKind::frictionless, {"", "", "push"})};
  auto model = runs::build_blocks(blocks, column(60));
  run_until(model, 0.9 * length / speed);
  const Vector3 force = forces_of(model).front();
  const Real expected = density * speed * velocity * side * side;  // impedance times velocity times area
  EXPECT_NEAR(force.z(), expected, 0.03 * expected);
  EXPECT_LT(force.head<2>().norm(), 1e-6 * expected);
}

TEST(moving_ground, compresses_a_specimen_as_a_pressure_does) {
  auto blocks = rock();
  blocks.joints.front().damping_ratio = 0.5;
  const Real height = 4 * side / 2, rate = 0.02, end = 4e-3;
  std::vector<Real> velocities(41, -rate);
  velocities[0] = 0, velocities[1] = -0.5 * rate;
  blocks.motions = {motion("platen", laws::MotionQuantity::velocity, velocities, 1e-4)};
  blocks.boundaries = {moving("bottom", cases::BoundaryKind::frictionless, {"", "", ""}),
                       moving("top", cases::BoundaryKind::frictionless, {"", "", "platen"})};
  auto model = runs::build_blocks(blocks, column(4));
  run_until(model, end);
  const auto forces = forces_of(model);
  const Real shortening = -cases::motion_of_case(blocks.motions.front()).at(model.simulation->now().seconds()).displacement;
  const Real modulus = -forces[1].z() / (side * side) / (shortening / height);
  // Pressure on the outer faces does not compress the last quarter of the uppermost cubes.
  EXPECT_LT(modulus, modulus_under_pressure());
  EXPECT_GT(modulus, modulus_under_pressure() * (1 - 0.25 * side / 2 / height));
  EXPECT_NEAR(forces[0].z(), -forces[1].z(), 0.02 * std::abs(forces[1].z()));
  const auto balance = model.simulation->energy_balance();
  const Real elastic = 0.5 * std::abs(forces[1].z()) * shortening;
  EXPECT_NEAR(balance[EnergyKind::elastic], elastic, 0.02 * elastic);
  EXPECT_LT(std::abs(balance.residual()), 1e-3 * balance[EnergyKind::work]);
}

TEST(moving_ground, carries_a_body_along_with_it) {
  auto blocks = rock();
  blocks.joints.front().damping_ratio = 0.5;
  std::vector<Real> velocities;
  for (int i = 0; i <= 40; ++i) velocities.push_back(0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / 40));
  blocks.motions = {motion("base", laws::MotionQuantity::velocity, velocities, 1e-4)};
  blocks.boundaries = {moving("bottom", cases::BoundaryKind::prescribed, {"base", "", ""})};
  auto model = runs::build_blocks(blocks, column(2));
  run_until(model, 8e-3);
  const Real moved = cases::motion_of_case(blocks.motions.front()).at(model.simulation->now().seconds()).displacement;
  EXPECT_NEAR(moved, 2e-3, 1e-9);
  const auto now = model.simulation->snapshot();
  const auto& bodies = model.simulation->bodies();
  for (std::size_t body = 0; body < bodies.motion.size(); ++body) {
    EXPECT_LT(now.velocity[body].norm(), 1e-4);
    EXPECT_LT((now.pose[body].position - bodies.start[body] - Vector3(moved, 0, 0)).norm(), 1e-3 * moved);
  }
}

TEST(moving_ground, lets_an_incident_wave_enter_and_leave) {
  auto blocks = rock();
  const int high = 60;
  const Real peak = 0.1, length = high * side / 2, duration = 4e-4;
  std::vector<Real> velocities;
  for (int i = 0; i <= 40; ++i) velocities.push_back(0.5 * peak * (1 - std::cos(2 * std::numbers::pi * i / 40)));
  blocks.motions = {motion("pulse", laws::MotionQuantity::velocity, velocities, duration / 40)};
  blocks.boundaries = {moving("bottom", cases::BoundaryKind::absorbing, {"", "", "pulse"})};
  cases::Constraint wide;  // as if in a body that is wide across the wave
  wide.regions = {"rock"};
  wide.translation = {true, true, false};
  wide.rotation = {true, true, true};
  blocks.constraints = {wide};
  auto model = runs::build_blocks(blocks, column(high));
  Real inside = 0, largest = 0, most = 0;
  model.simulation->start();
  const auto& bodies = model.simulation->bodies();
  while (model.simulation->now().seconds() < 3.2e-3) {
    model.simulation->advance();
    const Real time = model.simulation->now().seconds();
    for (std::size_t body = 0; body < bodies.motion.size(); ++body) {
      const Real speed = std::abs(bodies.motion[body].predicted_velocity.z()), height = bodies.start[body].z();
      if (height > 0.4 * length && height < 0.5 * length && time < 1e-3) inside = std::max(inside, speed);
      if (height > 0.99 * length) largest = std::max(largest, speed);
    }
    most = std::max(most, model.simulation->energy_balance()[EnergyKind::kinetic]);
  }
  EXPECT_NEAR(inside, peak, 0.05 * peak);
  EXPECT_NEAR(largest, 2 * peak, 0.05 * 2 * peak);
  const auto balance = model.simulation->energy_balance();
  EXPECT_LT(balance[EnergyKind::kinetic] + balance[EnergyKind::elastic], 0.01 * most);
  EXPECT_LT(std::abs(balance.residual()), 1e-3 * balance[EnergyKind::work]);
}

}  // namespace
}  // namespace sazare::methods::blocks
