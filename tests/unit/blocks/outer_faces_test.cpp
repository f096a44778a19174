#include "sazare/methods/blocks/outer_faces.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "sazare/parallel/threads.hpp"
#include "tests/support/blocks_scene.hpp"
#include "tests/support/force_probe.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind;

/// One block whose face in the plane x = 0 leans on the ground.
struct Leaning {
  explicit Leaning(FaceSprings springs)
      : bodies(one_block()), faces({face(springs, bodies)}, {MovingGround()}, bodies), probe(faces, bodies) {}

  static state::Bodies<3> one_block() {
    state::Bodies<3> made;
    const Quaternion tilted(Eigen::AngleAxis<Real>(0.4, Vector3(1, 2, 3).normalized()));
    state::add_body(made, 2.0, Vector3(-0.3, 0.1, 0.1), Vector3(0.01, 0.02, 0.03), tilted, 0.5);
    return made;
  }

  static OuterFace face(FaceSprings springs, const state::Bodies<3>& bodies) {
    OuterFace made;
    made.place = {Vector3(0, 0, 0), Vector3(0, 0.3, 0), Vector3(0, 0, 0.4)};
    made.normal = Vector3::UnitX();
    springs.corner_area = 0.02;
    for (std::size_t corner = 0; corner < 3; ++corner)
      springs.corners[corner] = bodies.motion[0].rotation.transpose() * (made.place[corner] - bodies.motion[0].position);
    made.springs = springs;
    return made;
  }

  state::Impulse<3> force() { return probe.forces()[0]; }

  state::Bodies<3> bodies;
  OuterFaces faces;
  test::ForceProbe<3> probe;
};

FaceSprings fixed() {
  FaceSprings springs;
  springs.normal_stiffness = 1e6;
  springs.shear_stiffness = 3e5;
  return springs;
}

FaceSprings frictionless() {
  FaceSprings springs;
  springs.normal_stiffness = 1e6;
  return springs;
}

FaceSprings absorbing() {
  FaceSprings springs;
  springs.normal_damping = 5e3;
  springs.shear_damping = 2e3;
  return springs;
}

TEST(outer_faces, give_no_force_where_the_block_was_put) { EXPECT_LT(Leaning(fixed()).force().linear.norm(), 1e-9); }

TEST(outer_faces, held_ones_push_back_as_the_slope_of_their_energy) {
  Leaning block(fixed());
  auto& motion = block.bodies.motion[0];
  motion.position += Vector3(1e-3, -2e-3, 1e-3);
  motion.rotation = state::turn(Vector3(0.01, 0.02, -0.01), 1) * motion.rotation;
  const auto force = block.force();
  for (int freedom = 0; freedom < 6; ++freedom)
    EXPECT_NEAR(test::component(force, freedom), test::energy_slope(block.probe, block.bodies, 0, freedom, 1e-6), 1e-5);
  EXPECT_GT(force.linear.norm(), 10);
}

TEST(outer_faces, held_ones_pull_as_well_as_they_push) {
  Leaning block(fixed());
  block.bodies.motion[0].position.x() -= 1e-3;
  EXPECT_NEAR(block.force().linear.x(), 1e6 * 0.06 * 1e-3, 1e-6);
}

TEST(outer_faces, frictionless_ones_let_the_block_slide) {
  Leaning block(frictionless());
  block.bodies.motion[0].position += Vector3(1e-3, 0.05, -0.03);
  const auto force = block.force().linear;
  EXPECT_NEAR(force.x(), -1e6 * 0.06 * 1e-3, 1e-6);
  EXPECT_LT(force.tail<2>().norm(), 1e-9);
}

TEST(outer_faces, absorbing_ones_are_dashpots_alone) {
  Leaning block(absorbing());
  block.bodies.motion[0].position += Vector3(0.1, 0.05, -0.03);
  EXPECT_LT(block.force().linear.norm(), 1e-9);
  block.bodies.motion[0].velocity = {2, 0, 3};
  const auto force = block.force().linear;
  EXPECT_NEAR(force.x(), -5e3 * 0.06 * 2, 1e-6);
  EXPECT_NEAR(force.z(), -2e3 * 0.06 * 3, 1e-6);
  EXPECT_EQ(block.probe.energy_balance()[EnergyKind::elastic], 0);
}

/// Energy left in a bar after a wave has run to its end and half way back, as a share of what it had.
Real energy_left(bool absorbing_end) {
  constexpr int cubes = 20;
  parallel::set_threads(1);
  auto blocks = test::bar_case();
  if (absorbing_end) blocks.boundaries = {{"end", cases::BoundaryKind::absorbing}};
  auto model = runs::build_blocks(blocks, test::cube_bar(cubes, 0.05, 6));
  const auto& bodies = model.simulation->bodies();
  Real before = 0;
  for (std::size_t body = 0; body < bodies.motion.size(); ++body)
    before += 0.5 * bodies.inertia[body].mass * bodies.motion[body].velocity.squaredNorm();
  model.simulation->start();
  while (model.simulation->now().seconds() < 1.5 * cubes * 0.05 / test::bar_speed) model.simulation->advance();
  const auto balance = model.simulation->energy_balance();
  EXPECT_EQ(model.joints->broken_count(), 0);
  return 1 + (balance[EnergyKind::kinetic] + balance[EnergyKind::elastic]) / before;
}

TEST(outer_faces, absorbing_ones_let_a_wave_leave) {
  // The plane dashpot is tuned to a wide body. The thin bar's impedance is 0.6 of it, which reflects 6 % of the energy;
  // the cubes scatter some more.
  EXPECT_LT(energy_left(true), 0.12);
  EXPECT_GT(energy_left(false), 0.95);
}

}  // namespace
}  // namespace sazare::methods::blocks
