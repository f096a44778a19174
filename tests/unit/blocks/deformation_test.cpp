/// Forces on the strains of deformable elements: those of joints, of boundaries, of pressures and of the elements themselves.

#include <gtest/gtest.h>

#include "sazare/levels/terms/face_pressure.hpp"
#include "sazare/methods/blocks/deformation/elements.hpp"
#include "sazare/methods/blocks/outer_faces.hpp"
#include "sazare/methods/blocks/run/joints/element_springs.hpp"
#include "tests/support/deformable_blocks.hpp"
#include "tests/support/force_probe.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind;

/// Two deformable blocks of rock with one joint, which fails in no test here.
struct StrainedPair {
  explicit StrainedPair(Real damping_ratio = 0) : StrainedPair(rock(damping_ratio), test::two_blocks()) {}
  StrainedPair(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh)
      : bodies(test::deformable_bodies(blocks, mesh)),
        faces(joined(blocks, mesh, bodies)),
        joints({runs::make_joint_kind(blocks.joints[0])}, faces, bodies),
        probe(joints, bodies) {}

  static cases::BlocksCase rock(Real damping_ratio) {
    auto blocks = test::deformable(test::two_block_case(true));
    cases::Joint& joint = blocks.joints[0];
    joint.damping_ratio = damping_ratio;
    joint.tensile_strength = joint.cohesion = 1e12;
    joint.fracture_energy = 1e12;
    return blocks;
  }
  static std::vector<JointFace> joined(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh,
                                       const state::Bodies<3>& bodies) {
    const auto map = geometry::build_face_map(mesh);
    const auto& shared = map.interior.at(0);
    JointFace face{shared.element_i, shared.element_j, 0, shared.face_i, shared.face_j, runs::face_corners(mesh, shared.nodes)};
    std::vector faces{face};
    runs::add_own_springs(blocks, runs::materials_by_element(blocks, mesh), bodies, faces);
    return faces;
  }

  /// Moves, turns and strains both, as no symmetry would.
  void disturb() {
    bodies.motion[0].position += Vector3(1e-6, -2e-6, 3e-6);
    bodies.motion[1].position += Vector3(4e-6, 2e-6, -1e-6);
    test::turn(bodies, 0, Vector3(1e-5, 2e-5, -1e-5));
    test::turn(bodies, 1, Vector3(-2e-5, 1e-5, 3e-5));
    test::strain_both(bodies);
  }

  state::Bodies<3> bodies;
  std::vector<JointFace> faces;
  Joints joints;
  test::ForceProbe<3> probe;
};

TEST(deformation, joints_pull_at_strains_and_motions_as_the_slope_of_their_energy) {
  StrainedPair pair;
  pair.disturb();
  const auto forces = pair.probe.forces();
  for (const Index body : {0, 1}) {
    const Vector6 found = pair.probe.force_on_strain(body), slope = test::strain_slope(pair.probe, pair.bodies, body, 1e-7);
    EXPECT_GT(found.norm(), 10);
    EXPECT_LT((found - slope).norm(), 1e-6 * found.norm()) << found.transpose() << " and " << slope.transpose();
    for (int freedom = 0; freedom < 6; ++freedom) {
      const Real force = test::component(forces[static_cast<std::size_t>(body)], freedom);
      const Real by_energy = test::energy_slope(pair.probe, pair.bodies, body, freedom, freedom < 3 ? 1e-9 : 1e-8);
      EXPECT_NEAR(force, by_energy, freedom < 3 ? 2e-2 : 2e-3) << "body " << body << ", freedom " << freedom;
    }
  }
  EXPECT_GT(forces[0].linear.norm(), 1e4);
}

TEST(deformation, joints_act_and_react_at_one_point) {
  StrainedPair pair(0.1);
  pair.disturb();
  pair.bodies.strain[0].predicted_rate << 1, 2, 3, -1, -2, 4;
  const auto forces = pair.probe.forces();
  EXPECT_EQ(forces[0].linear, -forces[1].linear);
  Vector3 moment = Vector3::Zero();
  for (std::size_t body = 0; body < 2; ++body)
    moment += forces[body].angular + pair.bodies.motion[body].position.cross(forces[body].linear);
  EXPECT_LT(moment.norm(), 1e-13 * forces[0].linear.norm());
}

TEST(deformation, forces_on_strains_are_the_same_in_a_turned_frame) {
  StrainedPair pair(0.1), turned(0.1);
  for (StrainedPair* each : {&pair, &turned}) {
    each->disturb();
    each->bodies.motion[1].velocity = Vector3(0.1, 0.2, -0.3);
    each->bodies.strain[1].predicted_rate << 1, 2, 3, -1, -2, 4;
  }
  test::turn_all(turned.bodies, Vector3(0.7, -0.4, 1.1));
  pair.probe.forces();
  turned.probe.forces();
  for (const Index body : {0, 1}) {
    const Vector6 here = pair.probe.force_on_strain(body), there = turned.probe.force_on_strain(body);
    EXPECT_LT((here - there).norm(), 1e-7 * here.norm());
  }
}

/// The power of the dashpots on all freedoms is that of a sum of squares, and none where the pair moves as one rigid body.
TEST(deformation, dashpots_of_joints_take_energy_and_resist_no_rigid_motion) {
  StrainedPair damped(0.2), free(0);
  for (StrainedPair* each : {&damped, &free}) {
    each->bodies.motion[0].velocity = Vector3(0.1, -0.2, 0.3);
    each->bodies.motion[1].spin = Vector3(3, -1, 2);
    each->bodies.strain[0].predicted_rate << 1, -2, 3, 0.5, -1, 2;
    each->bodies.strain[1].predicted_rate << -1, 1, 2, -3, 1, 0.5;
  }
  const auto with = damped.probe.forces(), without = free.probe.forces();
  Real power = 0;
  for (const Index body : {0, 1}) {
    const auto& motion = damped.bodies.motion[static_cast<std::size_t>(body)];
    const auto& first = with[static_cast<std::size_t>(body)];
    const auto& second = without[static_cast<std::size_t>(body)];
    power += (first.linear - second.linear).dot(motion.velocity) + (first.angular - second.angular).dot(motion.spin);
    power += (damped.probe.force_on_strain(body) - free.probe.force_on_strain(body))
                 .dot(damped.bodies.strain[static_cast<std::size_t>(body)].predicted_rate);
  }
  EXPECT_LT(power, -1);

  StrainedPair rigid(0.2);
  const Vector3 spin(3, -1, 2);
  for (auto& motion : rigid.bodies.motion) {
    motion.spin = spin;
    motion.velocity = spin.cross(motion.position);
  }
  EXPECT_LT(rigid.probe.forces()[0].linear.norm(), 1e-5 * with[0].linear.norm());
}

/// Moves, turns and strains both blocks along a path; `share` goes from 0 to 1.
void take_along_path(StrainedPair& pair, const StrainedPair& start, Real share) {
  const Real swing = std::sin(6 * share), other = std::cos(5 * share) - 1;
  pair.bodies = start.bodies;
  pair.bodies.motion[1].position += Vector3(-4e-6 * share, 3e-5 * swing, 2e-5 * other);
  test::turn(pair.bodies, 0, Vector3(1e-4 * swing, 2e-4 * other, 0));
  pair.bodies.strain[0].strain << 2e-2 * swing, -1e-2 * other, 0, 5e-3 * swing, 0, 1e-2 * other;
  pair.bodies.strain[1].strain << -2e-2 * other, 0, 1e-2 * swing, 0, 4e-3 * other, 0;
}

/// The work of the forces along a path in which the joint slips, which is what it stores and takes.
TEST(deformation, joints_that_slip_take_what_the_forces_do) {
  auto blocks = StrainedPair::rock(0);
  blocks.joints[0].cohesion = 1e6;
  blocks.joints[0].friction_coefficient = 0.3;
  std::array<Real, 2> off{};
  for (int fine = 0; fine < 2; ++fine) {
    StrainedPair pair(blocks, test::two_blocks()), start(blocks, test::two_blocks());
    const int steps = fine == 0 ? 4000 : 16000;
    Real work = 0;
    state::Bodies<3> before = start.bodies;
    auto forces_before = pair.probe.forces();
    std::array<Vector6, 2> strain_forces_before{pair.probe.force_on_strain(0), pair.probe.force_on_strain(1)};
    for (int step = 1; step <= steps; ++step) {
      take_along_path(pair, start, static_cast<Real>(step) / steps);
      const auto forces = pair.probe.forces();
      for (const Index body : {0, 1}) {
        const std::size_t b = at(body);
        const Vector6 on_strain = pair.probe.force_on_strain(body);
        const Matrix3 turned = pair.bodies.motion[b].rotation * before.motion[b].rotation.transpose();
        const Vector3 angle =
            0.5 * Vector3(turned(2, 1) - turned(1, 2), turned(0, 2) - turned(2, 0), turned(1, 0) - turned(0, 1));
        work -=
            0.5 * (forces[b].linear + forces_before[b].linear).dot(pair.bodies.motion[b].position - before.motion[b].position);
        work -= 0.5 * (forces[b].angular + forces_before[b].angular).dot(angle);
        work -= 0.5 * (on_strain + strain_forces_before[b]).dot(pair.bodies.strain[b].strain - before.strain[b].strain);
        strain_forces_before[b] = on_strain;
      }
      forces_before = forces;
      before = pair.bodies;
    }
    const auto energy = pair.probe.energy_balance();
    const Real found = energy[EnergyKind::elastic] + energy[EnergyKind::slip];
    EXPECT_GT(energy[EnergyKind::slip], 0.1 * work);
    off[at(fine)] = std::abs(found - work) / work;
  }
  EXPECT_LT(off[0], 1e-2);
  EXPECT_LT(off[1], 0.35 * off[0]) << off[0];
}

TEST(deformation, boundaries_pull_at_strains_as_the_slope_of_their_energy) {
  StrainedPair pair;
  OuterFace face;
  face.place = {Vector3(0, 0, 0), Vector3(0, 0.03, 0), Vector3(0, 0, 0.04)};
  face.normal = Vector3::UnitX();
  face.springs.corner_area = 0.02;
  face.springs.normal_stiffness = 1e9;
  face.springs.shear_stiffness = 3e8;
  for (std::size_t corner = 0; corner < 3; ++corner)
    face.springs.corners[corner] =
        pair.bodies.motion[0].rotation.transpose() * (face.place[corner] - pair.bodies.motion[0].position);
  face.traction = {Vector3(1e5, 2e5, 0), Vector3(1e5, 0, 0), Vector3(0, 0, 3e5)};
  OuterFaces ground({face}, {MovingGround()}, pair.bodies);
  test::ForceProbe<3> probe(ground, pair.bodies);
  pair.disturb();
  probe.forces();
  const Vector6 found = probe.force_on_strain(0), slope = test::strain_slope(probe, pair.bodies, 0, 1e-7);
  EXPECT_GT(found.norm(), 100);
  EXPECT_LT((found - slope).norm(), 1e-7 * found.norm());
}

/// Pressure p over the face of area vector a with its centre c does the work -p a . E c on a strain E.
TEST(deformation, pressure_works_on_the_strain_at_the_centre_of_its_face) {
  StrainedPair pair;
  terms::PressedFace face;
  face.area = Vector3(0.01, -0.02, 0.03);
  face.centre = Vector3(0.02, 0.01, -0.03);
  face.start = pair.bodies.motion[0].position + pair.bodies.motion[0].rotation * face.centre;
  terms::FacePressure pressure({{0, laws::PressureTable{{0, 1e3}, {2e6, 2e6}}, 1.0}}, {face}, pair.bodies);
  test::ForceProbe<3> probe(pressure, pair.bodies);
  pair.disturb();
  probe.forces();
  const Vector6 found = probe.force_on_strain(0);
  for (int number = 0; number < 6; ++number) {
    const Matrix3 strain = tensor_of(Vector6::Unit(number));
    EXPECT_NEAR(found[number], -2e6 * face.area.dot(strain * face.centre), 1e-9 * found.norm());
  }
}

TEST(deformation, elements_resist_strain_as_the_slope_of_their_energy_and_their_dashpots_take_energy) {
  StrainedPair pair;
  DeformableElement element;
  element.body = 1;
  element.volume = 2e-4;
  element.stiffness = laws::isotropic_stiffness({40e9, 0.25});
  element.stress_at_start << -1e6, -2e6, -3e6, 1e5, 0, 0;
  element.relaxation_time = 1e-6;
  Elements elements({element}, pair.bodies);
  test::ForceProbe<3> probe(elements, pair.bodies);
  pair.disturb();
  probe.forces();
  const Vector6 still = probe.force_on_strain(1), slope = test::strain_slope(probe, pair.bodies, 1, 1e-7);
  EXPECT_LT((still - slope).norm(), 1e-7 * still.norm());
  EXPECT_EQ(probe.force_on_strain(0), Vector6(Vector6::Zero()));
  Vector6& rate = pair.bodies.strain[1].predicted_rate;
  rate << 1, -2, 3, 0.5, -1, 2;
  probe.forces();
  const Real power = (probe.force_on_strain(1) - still).dot(rate);
  EXPECT_NEAR(power, -element.volume * element.relaxation_time * rate.dot(element.stiffness * rate), -1e-9 * power);
}

}  // namespace
}  // namespace sazare::methods::blocks
