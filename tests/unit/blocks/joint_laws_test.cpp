/// Joints of a law that is not in the list of laws, alone and beside others.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sazare/methods/blocks/joint_loops.hpp"
#include "sazare/methods/blocks/run/parts.hpp"
#include "tests/support/blocks_scene.hpp"
#include "tests/support/force_probe.hpp"

namespace sazare::methods::blocks {
namespace {

using terms::EnergyKind;

/// Softening along a parabola, s = s_t r^2 with r = (d_u - d)/(d_u - d_e); unloading goes to the origin.
template <class P>
struct ParabolicTension {
  P stiffness{}, strength{}, elastic_opening{}, failure_opening{};

  auto numbers() { return std::tie(stiffness, strength, elastic_opening, failure_opening); }
};

template <class P>
P elastic_peak(const ParabolicTension<P>& law) {
  return law.elastic_opening;
}
template <class P>
P elastic_limit(const ParabolicTension<P>& law) {
  return law.strength;
}
template <class P>
void set_stiffness(ParabolicTension<P>& law, P stiffness) {
  law.stiffness = stiffness;
  law.elastic_opening = law.strength / stiffness;
}
template <class P>
P failure_peak(const ParabolicTension<P>& law) {
  return law.failure_opening;
}
template <class P>
void scale_strength(ParabolicTension<P>& law, P factor, P of_length) {
  law.strength = law.strength * factor;
  law.elastic_opening = law.elastic_opening * factor;
  law.failure_opening = law.failure_opening * of_length;
}
template <class P, class T>
auto is_softened(const ParabolicTension<P>& law, T peak) {
  return peak > law.elastic_opening;
}
template <class P, class T>
auto has_failed(const ParabolicTension<P>& law, T peak) {
  return peak >= law.failure_opening;
}
template <class P, class T>
T remaining(const ParabolicTension<P>& law, T peak) {
  return maximum(law.failure_opening - peak, T{} + 0.0) / (law.failure_opening - law.elastic_opening);
}
template <class P, class T>
T softened_stress(const ParabolicTension<P>& law, T opening, T peak) {
  const T r = remaining(law, peak);
  const T unloading = select(is_softened(law, peak), law.strength * r * r / peak, T{} + law.stiffness);
  return opening * select(opening > 0.0, unloading, T{} + law.stiffness);
}
template <class P, class T>
T stored_energy(const ParabolicTension<P>&, T opening, T stress) {
  return 0.5 * opening * stress;
}
template <class P, class T>
T fracture_dissipation(const ParabolicTension<P>& law, T peak) {
  const T end = minimum(peak, T{} + law.failure_opening), r = remaining(law, end);
  const T softening = (law.failure_opening - law.elastic_opening) / 3.0 * (1.0 - r * r * r);
  const T under_envelope = law.strength * (0.5 * law.elastic_opening + softening);
  return select(is_softened(law, peak), under_envelope - 0.5 * law.strength * r * r * end, T{} + 0.0);
}

struct ParabolicSoftening {
  template <class P>
  using Tension = ParabolicTension<P>;
  template <class P>
  using Shear = laws::ShearParameters<P>;
};

using Linear = JointParameters<laws::LinearSoftening, Real>;
using Parabolic = JointParameters<ParabolicSoftening, Real>;
using LinearJoints = JointsOf<std::tuple<laws::LinearSoftening>>;
using ParabolicJoints = JointsOf<std::tuple<ParabolicSoftening>>;
using MixedJoints = JointsOf<std::tuple<laws::LinearSoftening, ParabolicSoftening>>;

constexpr Real stiffness = 450e9, strength = 6.66e6, elastic_opening = strength / stiffness, failure_opening = 4e-5;
constexpr Real fracture_energy = strength * (0.5 * elastic_opening + (failure_opening - elastic_opening) / 3);
const laws::JointShear shear{90e9, 6.66e6, 0.58};
const Linear linear{laws::JointTension::make(stiffness, strength, 99.67), shear, 22.6e6, 10.1e6};
const Parabolic parabolic{{stiffness, strength, elastic_opening, failure_opening}, shear, 22.6e6, 10.1e6};

std::vector<JointFace> faces_of(const geometry::TetraMesh& mesh) {
  std::vector<JointFace> faces;
  for (const auto& shared : geometry::build_face_map(mesh).interior) {
    JointFace& face = faces.emplace_back(JointFace{shared.element_i, shared.element_j, 0, shared.face_i, shared.face_j, {}});
    for (std::size_t corner = 0; corner < 3; ++corner)
      face.corners[corner] = mesh.nodes[static_cast<std::size_t>(shared.nodes[corner])];
  }
  return faces;
}

/// Blocks of a mesh, with a probe for any joints of theirs.
struct Scene {
  Scene(const cases::BlocksCase& blocks, const geometry::TetraMesh& mesh)
      : faces(faces_of(mesh)), bodies(runs::make_bodies(blocks, mesh, runs::materials_by_element(blocks, mesh))) {}

  std::vector<JointFace> faces;
  state::Bodies<3> bodies;
};

TEST(joint_laws, a_law_of_ones_own_takes_its_fracture_energy) {
  Scene pair(test::two_block_case(true), test::two_blocks());
  ParabolicJoints joints({parabolic}, pair.faces, pair.bodies);
  test::ForceProbe<3> probe(joints, pair.bodies);
  const Vector3 start = pair.bodies.motion[1].position;
  const Real area = vertex_count * Real{joints.record(0).vertex_area};
  constexpr int steps = 4000;
  constexpr Real last = 1.001 * failure_opening;
  Real work = 0, before = 0;
  for (int step = 1; step <= steps; ++step) {
    pair.bodies.motion[1].position = start + Vector3(last * step / steps, 0, 0);
    const Real force = -probe.forces({0})[1].linear.x();
    work += 0.5 * (before + force) * last / steps;
    before = force;
  }
  EXPECT_EQ(joints.state(0), JointState::broken);
  EXPECT_NEAR(work, fracture_energy * area, 1e-4 * work);
  EXPECT_NEAR(probe.energy_balance()[EnergyKind::fracture], fracture_energy * area, 1e-6 * work);
}

TEST(joint_laws, a_law_of_ones_own_has_forces_from_its_energy) {
  Scene pair(test::two_block_case(true), test::two_blocks());
  ParabolicJoints joints({parabolic}, pair.faces, pair.bodies);
  test::ForceProbe<3> probe(joints, pair.bodies);
  const Vector3 start = pair.bodies.motion[1].position;
  pair.bodies.motion[1].position = start + Vector3(0.5 * failure_opening, 0, 0);
  probe.forces({0});
  EXPECT_EQ(joints.state(0), JointState::softening);
  pair.bodies.motion[1].position = start + Vector3(0.4 * failure_opening, 1e-6, -2e-6);
  const auto forces = probe.forces({0});
  for (Index body = 0; body < 2; ++body)
    for (int freedom = 0; freedom < 6; ++freedom)
      EXPECT_NEAR(test::component(forces[static_cast<std::size_t>(body)], freedom),
                  test::energy_slope(probe, pair.bodies, body, freedom, freedom < 3 ? 1e-8 : 1e-7),
                  1e-7 * forces[1].linear.norm())
          << body << " " << freedom;
}

/// The faces of one law, renumbered as if it were the only one.
std::vector<JointFace> some_of(const std::vector<JointFace>& faces, Index law) {
  std::vector<JointFace> some;
  for (const JointFace& face : faces)
    if (face.kind == law) some.push_back(face);
  for (JointFace& face : some) face.kind = 0;
  return some;
}

TEST(joint_laws, beside_joints_of_another_law_each_does_what_it_does_alone) {
  Scene bar(test::bar_case(), test::cube_bar(5, 0.1, 2));
  for (std::size_t n = 0; n < bar.faces.size(); ++n) bar.faces[n].kind = n % 3 == 0 ? 1 : 0;
  MixedJoints mixed({linear, parabolic}, bar.faces, bar.bodies);
  LinearJoints first({linear}, some_of(bar.faces, 0), bar.bodies);
  ParabolicJoints second({parabolic}, some_of(bar.faces, 1), bar.bodies);
  ASSERT_GT(second.count(), lane_count);
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> by(-2e-5, 2e-5), speed(-1, 1);
  for (auto& motion : bar.bodies.motion)
    for (int axis = 0; axis < 3; ++axis) {
      motion.position[axis] += by(random);
      motion.velocity[axis] = speed(random);
    }
  bar.bodies.motion[bar.bodies.motion.size() / 2].position.z() += 3 * failure_opening;
  test::ForceProbe<3> probe(mixed, bar.bodies), of_first(first, bar.bodies), of_second(second, bar.bodies);
  const auto forces = probe.forces(), one = of_first.forces(), other = of_second.forces();
  for (std::size_t body = 0; body < forces.size(); ++body)
    EXPECT_LT((forces[body].linear - one[body].linear - other[body].linear).norm(), 1e-12 * forces[body].linear.norm());
  std::array<Index, 2> next{};
  std::array<int, 3> seen{};
  for (Index joint = 0; joint < mixed.count(); ++joint) {
    const Index law = mixed.record(joint).kind;
    const Index place = next[static_cast<std::size_t>(law)]++;
    const JointRecord& alone = law == 0 ? first.record(place) : second.record(place);
    EXPECT_EQ(mixed.state(joint), alone.state);
    for (std::size_t v = 0; v < vertex_count; ++v) {
      EXPECT_EQ(mixed.record(joint).vertex[v].corner, alone.vertex[v].corner);
      EXPECT_EQ(mixed.record(joint).vertex[v].peak, alone.vertex[v].peak);
    }
    ++seen[static_cast<std::size_t>(mixed.state(joint))];
  }
  for (const int count : seen) EXPECT_GT(count, 0) << seen[0] << seen[1] << seen[2] << "some intact, some softening, some broken";
  const auto balance = probe.energy_balance(), a = of_first.energy_balance(), b = of_second.energy_balance();
  for (const EnergyKind account : {EnergyKind::elastic, EnergyKind::fracture, EnergyKind::release, EnergyKind::slip})
    EXPECT_NEAR(balance[account], a[account] + b[account], 1e-12 * balance[account]);
}

}  // namespace
}  // namespace sazare::methods::blocks
