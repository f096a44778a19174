/// Bodies of deformable elements as a whole: momenta, energy, order, and rest under a stress that the ground already has.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/run/failure.hpp"
#include "tests/support/box_of_blocks.hpp"
#include "tests/support/deformable_blocks.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind;

/// A box of cubes of six deformable elements each, nodes moved so that no two are alike.
geometry::TetraMesh rock_box() {
  geometry::TetraMesh mesh;
  test::add_box(mesh, {"rock", Vector3(0.3, 0.1, -0.2), {3, 2, 2}, 0.1}, [](const Vector3& place) {
    return Vector3(0.012 * std::sin(37 * place.y()), 0.01 * std::cos(51 * place.x() + 1),
                   0.011 * std::sin(43 * place.x() + place.y()));
  });
  return mesh;
}

cases::BlocksCase deformable_rock() {
  auto blocks = test::elastic_rock(2700, 50e9, 0.25);
  blocks.materials[0].deformable = true;
  return blocks;
}

/// A body that swings: one element is hit.
runs::BlocksModel hit(cases::BlocksCase blocks, Real base_step) {
  blocks.time.base_step = base_step;
  blocks.time.history_interval = 64 * base_step;
  auto mesh = rock_box();
  mesh.region_names = {"rock", "hit"};
  mesh.region[10] = 1;
  blocks.materials[0].regions = {"rock", "hit"};
  test::move(blocks, "hit", Vector3(0.3, 0.2, -0.1));
  auto model = runs::build_blocks(blocks, std::move(mesh));
  model.simulation->start();
  return model;
}

TEST(deformed_body, keeps_its_momenta_and_its_energy_at_mixed_levels) {
  auto blocks = deformable_rock();
  blocks.joints[0].damping_ratio = 0.05;
  blocks.materials[0].bulk_damping_ratio = 0.05;
  auto model = hit(blocks, 2e-6);
  const test::Momenta before = test::momenta_of(model);
  test::run(model, 300);
  const test::Momenta after = test::momenta_of(model);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * before.linear.norm());
  const auto energy = model.simulation->energy_balance();
  EXPECT_LT(energy[EnergyKind::kinetic], 0);  // counts from the beginning
  EXPECT_GT(energy[EnergyKind::joint_dashpot], 0);
  EXPECT_LT(std::abs(energy.residual()), 2e-3 * energy[EnergyKind::joint_dashpot]);
}

/// Without dashpots the error of the energy swings with the body and does not grow.
TEST(deformed_body, keeps_its_energy_for_long_without_dashpots) {
  auto model = hit(deformable_rock(), 2e-6);
  const Real mass = model.simulation->bodies().inertia[10].mass, whole = 0.5 * mass * 0.14;  // of the element that is hit
  std::array<Real, 2> worst{};
  for (Real& of_half : worst)
    for (int part = 0; part < 100; ++part) {
      test::run(model, 10);
      of_half = std::max(of_half, std::abs(model.simulation->energy_balance().residual()));
    }
  EXPECT_LT(worst[0], 0.05 * whole);
  EXPECT_LT(worst[1], 1.3 * worst[0]);
}

Vector3 place_after(Real base_step, int steps, Real damping_ratio) {
  auto blocks = deformable_rock();
  blocks.joints[0].damping_ratio = damping_ratio;
  blocks.materials[0].bulk_damping_ratio = damping_ratio;
  auto model = hit(blocks, base_step);
  test::run(model, steps);
  return model.simulation->snapshot().pose[30].position;
}

TEST(deformed_body, has_errors_of_second_order_in_the_step) {
  for (const Real damping_ratio : {0.0, 0.1}) {
    const Vector3 exact = place_after(5e-7 / 32, 20 * 32, damping_ratio);
    const Real coarse = (place_after(5e-7, 20, damping_ratio) - exact).norm();
    const Real fine = (place_after(5e-7 / 2, 40, damping_ratio) - exact).norm();
    EXPECT_GT(coarse / fine, 3.4) << coarse << " and " << fine;
    EXPECT_LT(coarse / fine, 5) << coarse << " and " << fine;
  }
}

/// Ground under a stress that grows with depth, all of its sides held. Joints stand strained by the stress, which moves their
/// corners by 1e-5 of the size of an element; that share of the stress is not in balance.
TEST(deformed_body, rests_under_the_stress_that_it_has) {
  auto blocks = deformable_rock();
  blocks.time.levels = cases::Levels::uniform;
  blocks.gravity.acceleration = Vector3(0, 0, -9.81);
  blocks.initial_stress.normal = Vector3(-2e6, -3e6, -1e6);
  blocks.initial_stress.shear = Vector3(3e5, -2e5, 1e5);
  blocks.initial_stress.normal_per_depth = Vector3(-1e4, -1e4, -2700 * 9.81);
  geometry::TetraMesh mesh = rock_box();
  const auto map = geometry::build_face_map(mesh);
  mesh.surfaces = {{"sides", {}}};
  for (const auto& face : map.outer) mesh.surfaces[0].triangles.push_back(face.nodes);
  blocks.boundaries = {{"sides", cases::BoundaryKind::fixed}};
  auto model = runs::build_blocks(blocks, std::move(mesh));
  model.simulation->start();
  test::run(model, 200);
  const auto now = model.simulation->snapshot();
  for (std::size_t body = 0; body < now.velocity.size(); ++body) {
    EXPECT_LT(now.velocity[body].norm(), 1e-6);
    EXPECT_LT(now.strain[body].strain.norm(), 1e-5 * 3e6 / 50e9);
  }
}

/// Joints and elements in series yield as the material does: with a uniform stress each element's own part and its halves of the
/// joints add up to the isotropic compliance.
TEST(deformed_body, elements_yield_what_joints_leave_them) {
  const laws::ElasticModuli rock{50e9, 0.25};
  const std::vector<laws::YieldingFace> faces = {{Vector3(1, 1, 1).normalized(), 0.75},
                                                 {Vector3(-1, -1, 1).normalized(), 0.75},
                                                 {Vector3(-1, 1, -1).normalized(), 0.75},
                                                 {Vector3(1, -1, -1).normalized(), 0.75}};
  const Matrix6 joints = laws::joint_compliance(faces, laws::joint_moduli(rock));
  const Matrix6 sum = laws::element_stiffness(rock, joints).inverse() + joints;
  const Matrix6 asked = laws::isotropic_stiffness(rock).inverse();
  EXPECT_LT((sum - asked).norm(), 1e-12 * asked.norm());
  EXPECT_LT((laws::element_stiffness(rock, Matrix6::Zero()) - laws::isotropic_stiffness(rock)).norm(), 1e-3);
  // Faces that all look the same way yield more than the material along it: a quarter of the compliance is left.
  std::vector<laws::YieldingFace> flat(4, {Vector3::UnitZ(), 3.0});
  const Eigen::Matrix<Real, 6, 6> left = laws::element_stiffness(rock, laws::joint_compliance(flat, laws::joint_moduli(rock)));
  const Real softest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<Real, 6, 6>>(left).eigenvalues().minCoeff();
  EXPECT_GT(softest, 0.9 * 2 * rock.shear());
}

/// Two deformable blocks that are bonded or not.
runs::BlocksModel two_deformable(bool bonded) {
  return runs::build_blocks(test::deformable(test::two_block_case(bonded), 50e9), test::two_blocks());
}

/// Only a joint takes compliance out of its elements: a loose one is as stiff as the material.
TEST(deformed_body, elements_without_joints_are_as_stiff_as_the_material) {
  const laws::ElasticModuli rock{50e9, 0.25};
  const Matrix6 asked = laws::isotropic_stiffness(rock);
  const auto loose = two_deformable(false), bonded = two_deformable(true);
  EXPECT_LT((loose.elements->element_of(0)->stiffness - asked).norm(), 1e-12 * asked.norm());
  EXPECT_GT((bonded.elements->element_of(0)->stiffness - asked).norm(), 0.05 * asked.norm());
  Vector6 pressed = Vector6::Zero();
  pressed.head<3>().setConstant(-1e-3);
  EXPECT_NEAR(loose.elements->element_of(0)->volumetric_strain(pressed), -3e-3, 1e-15);
  EXPECT_LT(bonded.elements->element_of(0)->volumetric_strain(pressed), -3e-3);  // its joint yields too
}

TEST(deformed_body, an_element_that_strain_turns_inside_out_has_failed) {
  const auto strained_by = [&](Real along) {
    auto turned = two_deformable(false);
    turned.simulation->start();
    auto& bodies = const_cast<state::Bodies<3>&>(turned.simulation->bodies());  // no load would do it at once
    bodies.strain[1].strain << along, 0, 0, 0, 0, 0;
    return runs::find_failed_element(turned);
  };
  EXPECT_EQ(strained_by(-0.95), -1);
  EXPECT_EQ(strained_by(5), -1);  // drawn out, not turned
  EXPECT_EQ(strained_by(-1.05), 1);
  EXPECT_EQ(strained_by(std::nan("")), 1);
}

}  // namespace
}  // namespace sazare::methods::blocks
