/// Contact between blocks that are not bonded, through whole simulations of two blocks.

#include <gtest/gtest.h>

#include "sazare/methods/blocks/case/case.hpp"
#include "tests/support/blocks_scene.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind, test::run;

constexpr Real mass_of_block = 2390 * 0.1 * 0.1 * 0.1 / (6 * std::numbers::sqrt2);  // edge of 0.1 m

Vector3 velocity(const runs::BlocksModel& model, std::size_t body) { return model.simulation->snapshot().velocity[body]; }

cases::BlocksCase head_on(Real speed) {
  auto blocks = test::two_block_case(false);
  test::move(blocks, "left", {speed, 0, 0});
  test::move(blocks, "right", {-speed, 0, 0});
  blocks.time.base_step = 5e-8;
  return blocks;
}

runs::BlocksModel started(const cases::BlocksCase& blocks) {
  auto model = runs::build_blocks(blocks, test::two_blocks());
  model.simulation->start();
  return model;
}

TEST(contacts, blocks_that_touch_at_rest_stay_at_rest) {
  auto model = started(head_on(0));
  EXPECT_EQ(model.contacts->pair_count(), 1);
  run(model, 200);
  EXPECT_LT(velocity(model, 0).norm(), 1e-12);  // overlaps of 1e-17 m are rounding
  EXPECT_LT(velocity(model, 1).norm(), 1e-12);
}

TEST(contacts, without_dashpot_they_part_as_fast_as_they_met) {
  auto blocks = head_on(1);
  blocks.contact.normal_damping = 0;
  auto model = started(blocks);
  Real largest = 0;
  for (int step = 0; step < 200; ++step) {
    run(model, 1);
    largest = std::max(largest, model.simulation->energy_balance()[EnergyKind::elastic]);
  }
  EXPECT_NEAR(largest, mass_of_block, 0.02 * mass_of_block);  // two blocks at 1 m/s, all of it stored at the turn
  EXPECT_NEAR(velocity(model, 0).x(), -1, 1e-3);
  EXPECT_NEAR(velocity(model, 1).x(), 1, 1e-3);
  EXPECT_EQ(model.simulation->energy_balance()[EnergyKind::elastic], 0);
  EXPECT_LT(std::abs(model.simulation->energy_balance().residual()), 1e-3 * mass_of_block);
}

TEST(contacts, a_dashpot_takes_energy_and_the_energy_balance_finds_it) {
  auto blocks = head_on(1);
  blocks.contact.normal_damping = 2e3;
  auto model = started(blocks);
  run(model, 1200);
  const auto balance = model.simulation->energy_balance();
  EXPECT_LT(velocity(model, 1).x(), 0.98);
  EXPECT_GT(velocity(model, 1).x(), 0);
  EXPECT_GT(balance[EnergyKind::contact_dashpot], 0.01 * mass_of_block);
  EXPECT_NEAR(balance[EnergyKind::kinetic], -balance[EnergyKind::contact_dashpot], 1e-3 * mass_of_block);
}

TEST(contacts, blocks_that_part_are_not_held_and_forgotten_once_they_are_far) {
  auto model = started(head_on(-100));
  run(model, 2000);  // 20 mm apart; the skin is 3 mm
  EXPECT_EQ(velocity(model, 0).x(), -100);
  EXPECT_EQ(velocity(model, 1).x(), 100);
  EXPECT_EQ(model.contacts->pair_count(), 0);
}

TEST(contacts, friction_slows_the_slide_and_is_accounted_for) {
  auto blocks = head_on(1);
  blocks.initial_velocities.clear();
  test::move(blocks, "left", {1, 0.3, 0});
  test::move(blocks, "right", {-1, -0.3, 0});
  blocks.contact.normal_damping = 0;
  auto rough = started(blocks);
  blocks.contact.friction_coefficient = 0;
  auto smooth = started(blocks);
  run(rough, 1200);
  run(smooth, 1200);
  EXPECT_LT(std::abs(velocity(rough, 0).y()), std::abs(velocity(smooth, 0).y()) - 0.05);
  const auto balance = rough.simulation->energy_balance();
  EXPECT_GT(balance[EnergyKind::friction], 0.01 * mass_of_block);
  EXPECT_LT(std::abs(balance.residual()), 5e-3 * mass_of_block);
  EXPECT_LT(smooth.simulation->energy_balance()[EnergyKind::friction], 1e-12);
}

TEST(contacts, action_equals_reaction_through_a_rough_collision) {
  auto blocks = head_on(1);
  blocks.initial_velocities.clear();
  test::move(blocks, "left", {1, 0.3, 0.1});
  test::move(blocks, "right", {-1, -0.3, 0.2});
  blocks.time.limiter = cases::Limiter::stability;
  auto model = started(blocks);
  const test::Momenta before = test::momenta_of(model);
  run(model, 1200);
  const test::Momenta after = test::momenta_of(model);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-13 * mass_of_block);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-13 * mass_of_block);
  EXPECT_GT(velocity(model, 1).x(), 0);
}

/// Two blocks that do not hang together, the second one moved away from the first.
geometry::TetraMesh blocks_apart(const Vector3& away) {
  geometry::TetraMesh mesh = test::two_blocks();
  for (const std::size_t node : {0, 1, 2}) mesh.nodes.push_back(mesh.nodes[node] + away);
  mesh.nodes[4] += away;
  mesh.tetrahedra[1] = {4, 5, 7, 6};
  return mesh;
}

/// Elastic energy of all spheres of two blocks that overlap, whoever knows of them [J].
Real energy_of_all_spheres(const runs::BlocksModel& model, Real stiffness) {
  const auto& surface = model.contacts->surface();
  const auto pose = model.simulation->snapshot().pose;
  Real energy = 0;
  surface.visit_spheres(0, [&](Index a) {
    surface.visit_spheres(1, [&](Index b) {
      const Real overlap = touch(surface.placed(a, pose[0]), surface.placed(b, pose[1])).overlap;
      if (overlap > 0) energy += 0.5 * stiffness * overlap * overlap;
    });
  });
  return energy;
}

/// Blocks that are pressed together, and soft, while one slides over the other: new spheres meet all the time.
TEST(contacts, no_sphere_that_overlaps_is_overlooked) {
  for (const Real sliding : {1.0, 5.0, 20.0}) {
    auto blocks = head_on(3);
    blocks.joints.clear();
    blocks.initial_velocities.clear();
    test::move(blocks, "left", {3, sliding, 0.3 * sliding});
    test::move(blocks, "right", {-3, -sliding, 0});
    blocks.contact = {};
    blocks.contact.normal_stiffness = 1e6;
    blocks.time.base_step = 2e-7;
    auto model = runs::build_blocks(blocks, blocks_apart({2e-4, 0.003, 0.001}));
    model.simulation->start();
    Real most = 0, worst = 0;
    for (int step = 0; step < 5000; ++step) {
      run(model, 1);
      const Real energy = energy_of_all_spheres(model, blocks.contact.normal_stiffness);
      const terms::EnergyBalance balance = model.simulation->energy_balance();
      ASSERT_NEAR(balance[EnergyKind::elastic], energy, 1e-9 * mass_of_block) << step << ", at " << sliding;
      worst = std::max(worst, std::abs(balance.residual()));
      most = std::max(most, energy);
    }
    EXPECT_GT(most, 0.1 * mass_of_block);
    EXPECT_LT(worst, 1e-4 * mass_of_block);  // what overlaps without a force has energy that nobody gave
  }
}

/// Every cap leaves a collision that loses energy and never gives any.
TEST(contacts, no_cap_of_the_dashpot_gives_energy) {
  for (const auto cap : {cases::DampingCap::literal, cases::DampingCap::critical, cases::DampingCap::step}) {
    auto blocks = head_on(1);
    blocks.contact.damping_cap = cap;
    blocks.time.base_step = cap == cases::DampingCap::literal ? 1e-9 : 1e-7;
    auto model = started(blocks);
    Real last = 0;
    for (int round = 0; round < 40; ++round) {
      run(model, 50);
      const Real lost = model.simulation->energy_balance()[EnergyKind::contact_dashpot];
      EXPECT_GE(lost, last);
      last = lost;
    }
    EXPECT_GT(last, 0.1 * mass_of_block);
    EXPECT_LT(model.simulation->energy_balance()[EnergyKind::kinetic], 0);
  }
}

}  // namespace
}  // namespace sazare::methods::blocks
