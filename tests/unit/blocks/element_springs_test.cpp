/// Springs and dashpots that faces get from the elements beside them.

#include "sazare/methods/blocks/run/joints/element_springs.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sazare/methods/blocks/joints.hpp"
#include "sazare/methods/blocks/run/parts.hpp"
#include "tests/support/blocks_scene.hpp"
#include "tests/support/force_probe.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind;

constexpr Real young = 40e9, poisson = 0.25, size = 0.1;

/// Two blocks of rock, mirror images, whose joint gives no stiffness.
cases::BlocksCase two_rocks() {
  auto blocks = test::two_block_case(true);
  for (cases::Material& material : blocks.materials) {
    material.youngs_modulus = young;
    material.poisson_ratio = poisson;
  }
  cases::Joint& joint = blocks.joints[0];
  joint.normal_stiffness = joint.shear_stiffness = std::nullopt;
  joint.normal_damping = joint.shear_damping = 0;
  return blocks;
}

JointSprings springs_between(const cases::BlocksCase& blocks, Real of_size = size) {
  return runs::build_blocks(blocks, test::two_blocks(of_size)).joints->elastic(0);
}

/// Distance of a centre from the face: a quarter of the height of a regular tetrahedron.
Real distance(Real of_size) { return of_size * std::sqrt(2.0 / 3) / 4; }

TEST(element_springs, are_the_modulus_over_the_distance_of_the_centres) {
  const auto modulus = laws::spring_moduli({young, poisson});
  for (const Real of_size : {size, 8 * size}) {
    const auto springs = springs_between(two_rocks(), of_size);
    EXPECT_NEAR(springs.normal_stiffness * 2 * distance(of_size) / modulus.normal, 1, 1e-12);
    EXPECT_NEAR(springs.shear_stiffness * 2 * distance(of_size) / modulus.shear, 1, 1e-12);
    EXPECT_EQ(springs.normal_damping, 0);
  }
}

TEST(element_springs, of_two_materials_act_one_after_the_other) {
  auto blocks = two_rocks();
  blocks.materials[1].youngs_modulus = 5e9;
  blocks.materials[1].poisson_ratio = 0.1;
  const auto first = laws::spring_moduli({young, poisson}), second = laws::spring_moduli({5e9, 0.1});
  const auto springs = springs_between(blocks);
  EXPECT_NEAR(1 / springs.normal_stiffness, distance(size) * (1 / first.normal + 1 / second.normal),
              1e-12 / springs.normal_stiffness);
  EXPECT_NEAR(1 / springs.shear_stiffness, distance(size) * (1 / first.shear + 1 / second.shear),
              1e-12 / springs.shear_stiffness);
}

TEST(element_springs, of_a_joint_that_gives_its_own_are_those) {
  auto blocks = two_rocks();
  blocks.joints[0].normal_stiffness = 7e9;
  blocks.joints[0].shear_stiffness = 3e9;
  const auto springs = springs_between(blocks);
  EXPECT_EQ(springs.normal_stiffness, 7e9);
  EXPECT_EQ(springs.shear_stiffness, 3e9);
}

/// Two blocks that swing against each other along the normal with the damping ratio 1 come to rest without swinging back; with
/// less they do. The blocks are locked against turning.
TEST(element_springs, dashpots_are_a_share_of_what_is_critical) {
  const auto swing = [](Real ratio) {
    auto blocks = two_rocks();
    blocks.joints[0].damping_ratio = ratio;
    blocks.joints[0].tensile_strength = blocks.joints[0].cohesion = 1e12;
    blocks.joints[0].fracture_energy = 1e15;
    blocks.constraints = {{{"left", "right"}, {false, true, true}, {true, true, true}}};
    test::move(blocks, "right", {0.01, 0, 0});
    test::move(blocks, "left", {-0.01, 0, 0});
    auto model = runs::build_blocks(blocks, test::two_blocks(size));
    model.simulation->start();
    Real least = 0;
    for (int step = 0; step < 20000; ++step) {
      model.simulation->advance();
      const auto& motion = model.simulation->bodies().motion;
      const Real opening = motion[1].position.x() - motion[0].position.x() - 2 * distance(size);
      least = std::min(least, opening);
    }
    return least / distance(size);
  };
  EXPECT_GT(swing(1.001), -1e-12);
  EXPECT_LT(swing(0.9), -1e-9);
}

TEST(element_springs, of_ground_end_at_the_face) {
  const auto blocks = two_rocks();
  const auto modulus = laws::spring_moduli({young, poisson});
  const runs::OnGround element{blocks.materials[0], blocks.joints[0], 0.05, 100};
  const auto fixed = runs::ground_springs(cases::BoundaryKind::fixed, element);
  EXPECT_DOUBLE_EQ(fixed.normal_stiffness, modulus.normal / 0.05);
  EXPECT_DOUBLE_EQ(fixed.shear_stiffness, modulus.shear / 0.05);
  const auto sliding = runs::ground_springs(cases::BoundaryKind::frictionless, element);
  EXPECT_DOUBLE_EQ(sliding.normal_stiffness, fixed.normal_stiffness);
  EXPECT_EQ(sliding.shear_stiffness, 0);
}

TEST(element_springs, absorbing_ground_has_the_impedances_of_the_material_whatever_the_size) {
  auto blocks = two_rocks();
  const laws::ElasticModuli body{young, poisson};
  for (const Real distance : {0.01, 1.0}) {
    const auto springs =
        runs::ground_springs(cases::BoundaryKind::absorbing, {blocks.materials[0], blocks.joints[0], distance, 100});
    EXPECT_DOUBLE_EQ(springs.normal_damping, std::sqrt(body.confined() * blocks.materials[0].density));
    EXPECT_DOUBLE_EQ(springs.shear_damping, std::sqrt(body.shear() * blocks.materials[0].density));
    EXPECT_EQ(springs.normal_stiffness, 0);
  }
}

TEST(element_springs, ground_has_the_dashpots_of_the_joint) {
  auto blocks = two_rocks();
  blocks.joints[0].damping_ratio = 0.3;
  const auto springs = runs::ground_springs(cases::BoundaryKind::fixed, {blocks.materials[0], blocks.joints[0], 0.05, 100});
  EXPECT_DOUBLE_EQ(springs.normal_damping, 0.6 * std::sqrt(springs.normal_stiffness * 100));
  EXPECT_DOUBLE_EQ(springs.shear_damping, 0.6 * std::sqrt(springs.shear_stiffness * 100));
}

/// A bar of blocks, moved about so that some joints soften, some break and some slip.
struct MovedBar {
  explicit MovedBar(const std::vector<JointFace>& faces_, const JointKind& kind, const cases::BlocksCase& blocks,
                    const geometry::TetraMesh& mesh)
      : bodies(runs::make_bodies(blocks, mesh, runs::materials_by_element(blocks, mesh))),
        joints({kind}, faces_, bodies),
        probe(joints, bodies) {
    std::mt19937 random(7);
    std::uniform_real_distribution<Real> by(-2e-5, 2e-5), speed(-1, 1);
    for (auto& motion : bodies.motion)
      for (int axis = 0; axis < 3; ++axis) {
        motion.position[axis] += by(random);
        motion.velocity[axis] = speed(random);
      }
    bodies.motion[bodies.motion.size() / 2].position.z() += 1e-4;
  }

  state::Bodies<3> bodies;
  Joints joints;
  test::ForceProbe<3> probe;
};

/// Springs of a face that are those of its kind change no bit, whatever else the kind's own springs were.
void expect_same_as_kind(cases::Joint joint) {
  auto blocks = test::bar_case();
  const auto mesh = test::cube_bar(5, 0.1, 2);
  std::vector<JointFace> faces;
  for (const auto& shared : geometry::build_face_map(mesh).interior) {
    JointFace& face = faces.emplace_back(JointFace{shared.element_i, shared.element_j, 0, shared.face_i, shared.face_j, {}});
    for (std::size_t corner = 0; corner < 3; ++corner)
      face.corners[corner] = mesh.nodes[static_cast<std::size_t>(shared.nodes[corner])];
  }
  MovedBar plain(faces, runs::make_joint_kind(joint), blocks, mesh);
  for (JointFace& face : faces)
    face.own = JointSprings{*joint.normal_stiffness, *joint.shear_stiffness, joint.normal_damping, joint.shear_damping};
  joint.normal_stiffness = joint.shear_stiffness = std::nullopt;
  joint.normal_damping = joint.shear_damping = 1;
  MovedBar own(faces, runs::make_joint_kind(joint), blocks, mesh);
  const auto expected = plain.probe.forces(), forces = own.probe.forces();
  std::array<int, 3> seen{};
  for (std::size_t body = 0; body < forces.size(); ++body) {
    EXPECT_EQ(forces[body].linear, expected[body].linear);
    EXPECT_EQ(forces[body].angular, expected[body].angular);
    EXPECT_EQ(own.joints.rates(static_cast<Index>(body)).stiffness, plain.joints.rates(static_cast<Index>(body)).stiffness);
    EXPECT_EQ(own.joints.rates(static_cast<Index>(body)).damping, plain.joints.rates(static_cast<Index>(body)).damping);
  }
  for (Index face = 0; face < own.joints.count(); ++face) {
    EXPECT_EQ(own.joints.state(face), plain.joints.state(face));
    ++seen[std::min<std::size_t>(2, static_cast<std::size_t>(own.joints.state(face)))];
  }
  for (const int count : seen)
    EXPECT_GT(count, 0) << seen[0] << ' ' << seen[1] << ' ' << seen[2] << ": some intact, some softening, some broken";
  const auto balance = own.probe.energy_balance(), of_kind = plain.probe.energy_balance();
  for (const EnergyKind account : {EnergyKind::elastic, EnergyKind::fracture, EnergyKind::release, EnergyKind::slip})
    EXPECT_EQ(balance[account], of_kind[account]);
}

TEST(element_springs, act_as_the_same_springs_of_a_kind_do) { expect_same_as_kind(test::concrete_joint("concrete", "concrete")); }

TEST(element_springs, act_as_the_same_springs_of_a_kind_do_with_joints_that_soften_by_slip) {
  auto joint = test::concrete_joint("concrete", "concrete");
  joint.law = cases::JointLawName::mixed_mode;
  joint.law_parameters = {400.0, std::nullopt};
  expect_same_as_kind(joint);
}

}  // namespace
}  // namespace sazare::methods::blocks
