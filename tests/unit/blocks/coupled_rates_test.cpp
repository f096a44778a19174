#include <gtest/gtest.h>

#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/rates/coupled_rates.hpp"
#include "sazare/methods/blocks/run/parts.hpp"
#include "tests/support/blocks_scene.hpp"

namespace sazare::methods::blocks {
namespace {

/// The shared faces of a mesh, all of one kind, with their bodies.
struct Scene {
  Scene(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh)
      : bodies(runs::make_bodies(blocks, mesh, runs::materials_by_element(blocks, mesh))),
        kinds{elastic_joint(runs::make_joint_kind(blocks.joints[0]))} {
    for (const auto& shared : geometry::build_face_map(mesh).interior) {
      JointFace face{shared.element_i, shared.element_j, 0, shared.face_i, shared.face_j, {}};
      for (std::size_t corner = 0; corner < 3; ++corner)
        face.corners[corner] = mesh.nodes[static_cast<std::size_t>(shared.nodes[corner])];
      faces.push_back(face);
    }
    held = joint_rates(kinds, faces, bodies);
  }

  Real coupling() const { return coupled_damping(kinds, faces, bodies, held); }

  state::Bodies<3> bodies;
  std::vector<ElasticJoint> kinds;
  std::vector<JointFace> faces;
  std::vector<terms::Rates> held;
};

TEST(coupled_rates, two_equal_blocks_that_do_not_turn_reach_the_bound) {
  Scene pair(test::two_block_case(true), test::two_blocks());
  for (auto& locks : pair.bodies.locks) locks.rotation = 0b111;
  pair.held = joint_rates(pair.kinds, pair.faces, pair.bodies);
  EXPECT_DOUBLE_EQ(pair.coupling(), 2);
}

TEST(coupled_rates, without_dashpots_nothing_is_coupled) {
  auto blocks = test::two_block_case(true);
  blocks.joints[0].normal_damping = blocks.joints[0].shear_damping = 0;
  EXPECT_EQ(Scene(blocks, test::two_blocks()).coupling(), 1);
}

TEST(coupled_rates, a_mesh_stays_below_the_bound_for_any_neighbours) {
  auto blocks = test::bar_case();
  blocks.joints[0].normal_damping = 22.6e6;
  blocks.joints[0].shear_damping = 10.1e6;
  const Scene bar(blocks, test::cube_bar(8, 0.1, 2));
  EXPECT_GT(bar.coupling(), 1.2);
  EXPECT_LT(bar.coupling(), 1.95);
}

/// Kinetic energy left of a bar that only dashpots hold together, after many steps of all elements.
Real left_after_steps(Real fraction_of_stable) {
  auto blocks = test::bar_case();
  blocks.joints[0].normal_stiffness = blocks.joints[0].shear_stiffness = 1e3;
  blocks.joints[0].tensile_strength = blocks.joints[0].cohesion = 1e3;
  blocks.joints[0].normal_damping = 22.6e6;
  blocks.joints[0].shear_damping = 10.1e6;
  blocks.time.levels = cases::Levels::uniform;
  blocks.time.limiter = cases::Limiter::none;
  blocks.time.base_step = 1e-9;
  const auto mesh = test::cube_bar(8, 0.1, 2);
  const auto stable = runs::build_blocks(blocks, mesh).stable_step;
  blocks.time.base_step = fraction_of_stable * *std::ranges::min_element(stable);
  const auto model = runs::build_blocks(blocks, mesh);
  model.simulation->start();
  for (int step = 0; step < 3000; ++step) model.simulation->advance();
  return model.simulation->energy_balance()[terms::EnergyKind::kinetic];
}

TEST(coupled_rates, half_the_stable_step_is_stable_and_half_as_much_again_is_not) {
  EXPECT_LT(left_after_steps(0.5), 0) << "the head's energy goes into the dashpots";
  EXPECT_FALSE(left_after_steps(0.75) < 1) << "it grows";
}

}  // namespace
}  // namespace sazare::methods::blocks
