/// A joint that has failed behaves exactly as a contact that never was bonded.

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/blocks_scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::blocks {
namespace {

using test::run;

/// A checkpoint whose bodies can be exchanged for those of another one.
class ExchangedBodies final : public Archive {
public:
  ExchangedBodies(test::MemoryArchive& own, state::Bodies<3> bodies) : own_(own), bodies_(std::move(bodies)) {}
  bool reading() const override { return true; }

protected:
  void write(const std::string&, std::span<const std::byte>) override {}
  std::vector<std::byte> read(const std::string& name) override {
    const auto bytes_of = [](const auto& column) {
      const auto bytes = std::as_bytes(std::span(column));
      return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
    if (name == "motion") return bytes_of(bodies_.motion);
    if (name == "inertia") return bytes_of(bodies_.inertia);
    return own_.columns().at(name);
  }

private:
  test::MemoryArchive& own_;
  state::Bodies<3> bodies_;
};

void set_bodies(levels::Simulation<3>& simulation, const state::Bodies<3>& bodies) {
  test::MemoryArchive own;
  simulation.columns(own);
  ExchangedBodies exchanged(own, bodies);
  simulation.columns(exchanged);
}

runs::BlocksModel parting(bool bonded) {
  auto blocks = test::two_block_case(bonded);
  test::move(blocks, "left", {-60, 0.1, 0.05});
  test::move(blocks, "right", {60, -0.2, 0.1});
  blocks.time.base_step = 5e-9;
  auto model = runs::build_blocks(blocks, test::two_blocks());
  model.simulation->start();
  return model;
}

Real gap(const runs::BlocksModel& model) {
  const auto at = model.simulation->snapshot();
  return (at.pose[1].position - at.pose[0].position).x() - 2 * 0.1 * std::sqrt(2.0 / 3) / 4;
}

/// The two blocks of a model with their velocities reversed along x, so that they meet again, with a glancing blow.
state::Bodies<3> turned_round(const runs::BlocksModel& model) {
  state::Bodies<3> bodies = model.simulation->bodies();
  for (auto& motion : bodies.motion) motion.velocity.x() *= -1;
  bodies.motion[0].velocity += Vector3(0, 0.8, -0.3);
  bodies.motion[1].velocity += Vector3(0, -0.5, 0.9);
  return bodies;
}

TEST(failed_joint, behaves_exactly_as_a_contact_that_never_was_bonded) {
  auto failed = parting(true), never_bonded = parting(false);
  run(failed, 20000);
  run(never_bonded, 20000);
  ASSERT_EQ(failed.joints->broken_count(), 1);
  ASSERT_GT(gap(failed), 5e-3) << "farther apart than the skin of 3 mm";
  ASSERT_GT(gap(never_bonded), 5e-3);
  ASSERT_EQ(failed.contacts->pair_count(), 0);
  ASSERT_EQ(never_bonded.contacts->pair_count(), 0);

  const state::Bodies<3> bodies = turned_round(failed);
  set_bodies(*failed.simulation, bodies);
  set_bodies(*never_bonded.simulation, bodies);
  for (int round = 0; round < 60; ++round) {
    run(failed, 1000);
    run(never_bonded, 1000);
    const auto &one = failed.simulation->bodies(), &other = never_bonded.simulation->bodies();
    for (std::size_t body = 0; body < 2; ++body) {
      ASSERT_EQ(one.motion[body].position, other.motion[body].position) << round;
      ASSERT_EQ(one.motion[body].velocity, other.motion[body].velocity) << round;
      ASSERT_EQ(one.motion[body].rotation, other.motion[body].rotation) << round;
      ASSERT_EQ(one.motion[body].angular_momentum, other.motion[body].angular_momentum) << round;
    }
  }
  EXPECT_GT(failed.simulation->energy_balance()[terms::EnergyKind::contact_dashpot], 1) << "they never touched";
  EXPECT_GT((failed.simulation->bodies().motion[0].velocity - bodies.motion[0].velocity).norm(), 1);
}

TEST(failed_joint, released_faces_that_overlap_do_not_fly_apart) {
  // The face breaks at one vertex while another is pressed in: what overlaps then gives no force of its own.
  auto blocks = test::two_block_case(true);
  test::move(blocks, "left", {-10, 0, 0});
  test::move(blocks, "right", {10, 0, 0});
  blocks.joints[0].normal_damping = blocks.joints[0].shear_damping = 0;
  auto model = runs::build_blocks(blocks, test::two_blocks());
  state::Bodies<3> bodies = model.simulation->bodies();
  for (auto& motion : bodies.motion) motion.velocity.setZero();
  bodies.motion[1].spin = {0, -400, 0};  // opens above the hinge, closes below it
  bodies.motion[1].angular_momentum = bodies.motion[1].rotation * bodies.inertia[1].inverse_moments.cwiseInverse().asDiagonal() *
                                      bodies.motion[1].rotation.transpose() * bodies.motion[1].spin;
  set_bodies(*model.simulation, bodies);
  model.simulation->start();
  while (model.joints->broken_count() == 0 && model.simulation->now().seconds() < 1e-4) model.simulation->advance();
  ASSERT_EQ(model.joints->broken_count(), 1);
  const auto before = model.simulation->energy_balance();
  EXPECT_GT(before[terms::EnergyKind::release], 0);
  EXPECT_LT(before[terms::EnergyKind::elastic], 1e-6 * before[terms::EnergyKind::release]) << "contacts begin without energy";
}

}  // namespace
}  // namespace sazare::methods::blocks
