/// Contacts of deformable blocks after failure, or of blocks that were never bonded: forces on strains, energy, momenta.

#include <gtest/gtest.h>

#include "sazare/geometry/face_map.hpp"
#include "sazare/methods/blocks/contacts.hpp"
#include "sazare/methods/blocks/run/joints/element_stress.hpp"
#include "tests/support/box_of_blocks.hpp"
#include "tests/support/deformable_blocks.hpp"
#include "tests/support/force_probe.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind;

/// Two deformable blocks without a joint, pressed into each other, strained and turned as no symmetry would.
struct TouchingPair {
  explicit TouchingPair(const laws::SphereContact& law)
      : mesh(test::two_blocks()),
        bodies(test::deformable_bodies(test::deformable(test::two_block_case(false)), mesh)),
        joints({}, {}, bodies),
        contacts(law, 5, joints, {mesh.nodes, mesh.tetrahedra}, free_faces(), bodies),
        probe(contacts, bodies) {
    bodies.motion[1].position += Vector3(-8e-5, 2e-6, -3e-6);
    test::turn(bodies, 0, Vector3(1e-4, 2e-4, -1e-4));
    test::turn(bodies, 1, Vector3(-2e-4, 1e-4, 3e-4));
    test::strain_both(bodies);
  }

  static std::vector<FreeFace> free_faces() {
    std::vector<FreeFace> all;
    for (const Index body : {0, 1})
      for (int face = 0; face < 4; ++face) all.push_back({body, face});
    return all;
  }

  geometry::TetraMesh mesh;
  state::Bodies<3> bodies;
  Joints joints;
  Contacts contacts;
  test::ForceProbe<3> probe;
};

TEST(deformable_contacts, push_strains_and_motions_as_the_slope_of_their_energy) {
  TouchingPair pair({1.5e9, 0, 0});
  const auto forces = pair.probe.forces();
  ASSERT_GT(forces[1].linear.norm(), 1e4);
  for (const Index body : {0, 1}) {
    const Vector6 found = pair.probe.force_on_strain(body), slope = test::strain_slope(pair.probe, pair.bodies, body, 1e-7);
    EXPECT_GT(found.norm(), 100);
    EXPECT_LT((found - slope).norm(), 1e-6 * found.norm()) << found.transpose() << " and " << slope.transpose();
    for (int freedom = 0; freedom < 6; ++freedom) {
      const Real force = test::component(forces[static_cast<std::size_t>(body)], freedom);
      const Real by_energy = test::energy_slope(pair.probe, pair.bodies, body, freedom, freedom < 3 ? 1e-9 : 1e-8);
      EXPECT_NEAR(force, by_energy, 1e-5 * forces[1].linear.norm()) << "body " << body << ", freedom " << freedom;
    }
  }
}

TEST(deformable_contacts, push_alike_in_a_turned_frame_and_at_one_point) {
  const laws::SphereContact rough{1.5e9, 3e4, 0.5};
  TouchingPair pair(rough), turned(rough);
  for (TouchingPair* each : {&pair, &turned}) {
    each->bodies.motion[1].velocity = Vector3(-0.1, 0.2, -0.3);
    each->bodies.motion[0].spin = Vector3(1, -2, 3);
    each->bodies.strain[0].predicted_rate << 1, 2, 3, -1, -2, 4;
    each->bodies.strain[1].predicted_rate << -2, 1, 0, 3, 1, -1;
  }
  const Vector3 by(0.3, -0.5, 0.2);
  test::turn_all(turned.bodies, by);
  const auto forces = pair.probe.forces(), others = turned.probe.forces();
  Vector3 moment = Vector3::Zero();
  for (std::size_t body = 0; body < 2; ++body) {
    const Vector6 found = pair.probe.force_on_strain(static_cast<Index>(body));
    EXPECT_LT((found - turned.probe.force_on_strain(static_cast<Index>(body))).norm(), 1e-9 * found.norm());
    EXPECT_LT((state::turn(by, 1) * forces[body].linear - others[body].linear).norm(), 1e-9 * forces[body].linear.norm());
    moment += forces[body].angular + pair.bodies.motion[body].position.cross(forces[body].linear);
  }
  EXPECT_EQ(forces[0].linear, -forces[1].linear);
  EXPECT_LT(moment.norm(), 1e-13 * forces[0].linear.norm());
}

/// Dashpots and friction take energy from any motion, that of the strains included.
TEST(deformable_contacts, take_energy_by_dashpots_and_friction) {
  for (const Real sign : {-1.0, 1.0}) {
    TouchingPair rough({1.5e9, 3e4, 0.5, laws::DampingCap::literal}), smooth({1.5e9, 0, 0});
    for (TouchingPair* each : {&rough, &smooth}) {
      each->bodies.strain[0].predicted_rate << 1, 2, 3, -1, -2, 4;
      each->bodies.strain[1].predicted_rate << -2, 1, 0, 3, 1, -1;
      for (state::Strain& strain : each->bodies.strain) strain.predicted_rate *= sign;
    }
    rough.probe.forces();
    smooth.probe.forces();
    Real power = 0;
    for (const Index body : {0, 1})
      power += (rough.probe.force_on_strain(body) - smooth.probe.force_on_strain(body))
                   .dot(rough.bodies.strain[static_cast<std::size_t>(body)].predicted_rate);
    EXPECT_LT(power, -1);
  }
}

/// Two cubes of six deformable elements each, a little askew.
geometry::TetraMesh two_cubes(Real gap) {
  geometry::TetraMesh mesh;
  test::add_box(mesh, {"left", Vector3(0, 0, 0), {1, 1, 1}, 0.1});
  test::add_box(mesh, {"right", Vector3(0.1 + gap, 1e-4, -2e-4), {1, 1, 1}, 0.1});
  return mesh;
}

cases::BlocksCase two_rocks() {
  auto blocks = test::two_block_case(false);
  blocks.joints = {test::concrete_joint("left", "left"), test::concrete_joint("right", "right")};
  blocks = test::deformable(blocks);
  for (cases::Joint& joint : blocks.joints) {
    joint.cohesion = joint.tensile_strength = 1e9;
    joint.fracture_energy = 1e7;
  }
  blocks.contact.normal_damping = 0;
  blocks.contact.friction_coefficient = 0;
  blocks.time.base_step = 1e-7;
  blocks.time.history_interval = 1e-5;
  return blocks;
}

runs::BlocksModel met(const cases::BlocksCase& blocks, int steps) {
  auto model = runs::build_blocks(blocks, two_cubes(2e-7));
  model.simulation->start();
  test::run(model, steps);
  return model;
}

TEST(deformable_contacts, keep_energy_and_momenta_in_a_collision) {
  auto blocks = two_rocks();
  test::move(blocks, "left", Vector3(1, 0.2, 0));
  const Real whole = 0.5 * 2390 * 1e-3 * 1.04;
  Real before = 0, most = 0;
  auto model = runs::build_blocks(blocks, two_cubes(2e-7));
  model.simulation->start();
  const test::Momenta at_first = test::momenta_of(model);
  for (int step = 0; step < 40; ++step) {
    test::run(model, 25);
    before = std::max(before, std::abs(model.simulation->energy_balance().residual()));
    most = std::max(most, model.simulation->energy_balance()[EnergyKind::elastic]);
  }
  EXPECT_GT(most, 0.2 * whole);  // that of the strains and of the contacts
  EXPECT_LT(before, 2e-3 * whole);
  const test::Momenta now = test::momenta_of(model);
  EXPECT_LT((now.linear - at_first.linear).norm(), 1e-12 * at_first.linear.norm());
  EXPECT_LT((now.angular - at_first.angular).norm(), 1e-12 * at_first.linear.norm());
}

TEST(deformable_contacts, find_what_dashpots_and_friction_have_taken) {
  auto blocks = two_rocks();
  blocks.contact.normal_damping = 2e4;
  blocks.contact.friction_coefficient = 0.5;
  test::move(blocks, "left", Vector3(1, 0.2, 0));
  const auto model = met(blocks, 1000);
  const auto energy = model.simulation->energy_balance();
  EXPECT_GT(energy[EnergyKind::friction], 1e-3);
  EXPECT_GT(energy[EnergyKind::contact_dashpot], 1e-3);
  EXPECT_LT(std::abs(energy.residual()), 2e-3 * (energy[EnergyKind::friction] + energy[EnergyKind::contact_dashpot]));
}

/// Two cubes without a joint between them under a gravity that presses them onto each other and onto a frictionless wall: the
/// mean stress in each is that of what it carries, p on its far face and its own weight.
TEST(deformable_contacts, carry_stress_through_an_open_crack) {
  auto blocks = two_rocks();
  const Real area = 0.01, pressure = 1e6, gravity = pressure * area / (2390 * 1e-3);
  blocks.gravity.acceleration = Vector3(-gravity, 0, 0);
  for (cases::Material& material : blocks.materials) material.bulk_damping_ratio = 0.3;
  for (cases::Joint& joint : blocks.joints) joint.damping_ratio = 0.3;
  blocks.contact.normal_damping = 2e4;
  auto mesh = two_cubes(0);
  mesh.surfaces = {{"wall", {}}};
  for (const auto& outer : geometry::build_face_map(mesh).outer)
    if (std::ranges::all_of(outer.nodes, [&](Index node) { return mesh.nodes[at(node)].x() < 1e-9; }))
      mesh.surfaces[0].triangles.push_back(outer.nodes);
  blocks.boundaries = {{"wall", cases::BoundaryKind::frictionless}};
  auto model = runs::build_blocks(blocks, mesh);
  model.simulation->start();
  test::run(model, 20000);
  const auto stresses = runs::element_stresses(model, model.simulation->snapshot());
  std::array<Real, 2> mean{};
  for (std::size_t element = 0; element < stresses.normal.size(); ++element)
    mean[at(model.mesh.region[element])] +=
        stresses.normal[element].x() * geometry::volume(geometry::corners_of(mesh, static_cast<Index>(element))) / 1e-3;
  EXPECT_NEAR(mean[0], -1.5 * pressure, 0.02 * pressure);
  EXPECT_NEAR(mean[1], -0.5 * pressure, 0.02 * pressure);
}

}  // namespace
}  // namespace sazare::methods::blocks
