#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "sazare/core/error.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh;

constexpr Real modulus = 2e11, area = 1e-2, second_moment = 2e-5, density = 7850, length = 4;

MemberSet beam(std::vector<std::array<Index, 2>> lines) {
  MemberSet set;
  set.name = "beam";
  set.youngs_modulus = modulus;
  set.area = area;
  set.second_moment = second_moment;
  set.density = density;
  set.lines = std::move(lines);
  return set;
}

/// Nodes on a straight line, with beams from one to the next, without any ground.
template <int D>
BodyDescription straight(const Vector3& along, int pieces) {
  BodyDescription body;
  body.mesh.dimension = D;
  std::vector<std::array<Index, 2>> lines;
  for (Index i = 0; i <= pieces; ++i) {
    body.mesh.nodes.push_back(along * (length * i / pieces));
    body.mesh.node_tags.push_back(i + 1);
    if (i > 0) lines.push_back({i - 1, i});
  }
  body.members = {beam(lines)};
  return body;
}

template <int D>
void clamp(const Body<D>& body, std::size_t rotation, Supports<D>& supports) {
  for (int axis = 0; axis < D; ++axis) supports.held.push_back({body.members().node_of(rotation), axis, Support::no_motion, 0});
  supports.clamped.push_back(body.members().node_of(rotation));
}

FemRules statics() {
  FemRules rules;
  rules.step = 1;
  rules.statics = true;
  rules.tolerance = 1e-10;
  return rules;
}

template <int D>
void check_cantilever(const Vector3& direction) {
  const Vector3 along = direction.normalized();
  const Vector3 across = D == 2 ? Vector3(-along.y(), along.x(), 0) : Vector3(along.unitOrthogonal());
  auto body = std::make_unique<Body<D>>(straight<D>(along, 3));
  Supports<D> supports;
  clamp<D>(*body, 0, supports);
  const Real push = 500, pull = 2e4;
  NodalColumn force(body->mesh().nodes.size() * D, 0);
  for (int axis = 0; axis < D; ++axis) force[3 * D + static_cast<std::size_t>(axis)] = push * across[axis] + pull * along[axis];
  supports.loads = {{"end", force, 0}};
  FemStepper<D> stepper(std::move(body), supports, statics());
  stepper.start();
  stepper.advance();
  Vector3 end = Vector3::Zero();
  for (int axis = 0; axis < D; ++axis) end[axis] = stepper.state().displacement[3 * D + static_cast<std::size_t>(axis)];
  const Real deflection = push * length * length * length / (3 * modulus * second_moment);
  EXPECT_NEAR(end.dot(across), deflection, 1e-9 * deflection);
  EXPECT_NEAR(end.dot(along), pull * length / (modulus * area), 1e-9 * deflection);
  const MemberForces found =
      stepper.body().members().forces(0, stepper.state().displacement, stepper.state().velocity, stepper.state().memory.members);
  EXPECT_NEAR(found.largest_axial, pull, 1e-6 * pull);
  EXPECT_NEAR(found.least_axial, pull, 1e-6 * pull);
  EXPECT_NEAR(found.shear, push, 1e-6 * push);
  EXPECT_NEAR(found.moment, push * length, 1e-6 * push * length);
  EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9 * stepper.work().loads);
}

TEST(beam, bends_and_stretches_as_a_cantilever) {
  check_cantilever<2>({1, 0, 0});
  check_cantilever<2>({1, 2, 0});
  check_cantilever<3>({0, 0, -1});
  check_cantilever<3>({1, 2, 3});
}

/// Two clamped columns under a beam of the same length and section, pushed at its height. Kleinlogel's formulas with k = 1.
TEST(beam, makes_a_portal_frame) {
  BodyDescription description;
  description.mesh.dimension = 2;
  description.mesh.nodes = {{0, 0, 0}, {0, length, 0}, {length, length, 0}, {length, 0, 0}};
  description.mesh.node_tags = {1, 2, 3, 4};
  MemberSet columns = beam({{0, 1}, {3, 2}}), rail = beam({{1, 2}});
  columns.area = rail.area = 10;  // does not stretch
  description.members = {columns, rail};
  auto body = std::make_unique<Body<2>>(std::move(description));
  Supports<2> supports;
  clamp<2>(*body, 0, supports);
  clamp<2>(*body, 3, supports);
  const Real push = 1000;
  NodalColumn force(8, 0);
  force[2] = force[4] = push / 2;
  supports.loads = {{"wind", force, 0}};
  FemStepper<2> stepper(std::move(body), supports, statics());
  stepper.start();
  stepper.advance();
  const auto forces = [&](std::size_t set) {
    return stepper.body().members().forces(set, stepper.state().displacement, stepper.state().velocity,
                                           stepper.state().memory.members);
  };
  EXPECT_NEAR(forces(0).moment, push * length / 2 * 4 / 7, 1e-4 * push);
  EXPECT_NEAR(forces(1).moment, push * length / 2 * 3 / 7, 1e-4 * push);
  EXPECT_NEAR(forces(0).shear, push / 2, 1e-4 * push);
}

template <int D>
Eigen::MatrixXd dense(const BlockMatrix<D>& matrix) {
  const auto size = static_cast<Eigen::Index>(matrix.pattern().nodes() * D);
  Eigen::MatrixXd all(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    NodalColumn unit(static_cast<std::size_t>(size), 0), column(unit);
    unit[static_cast<std::size_t>(i)] = 1;
    matrix.multiply(unit, 1, column);
    all.col(i) = Eigen::Map<Eigen::VectorXd>(column.data(), size);
  }
  return all;
}

/// The first two bending modes of a cantilever of ten beams.
TEST(beam, has_the_natural_frequencies_of_a_cantilever) {
  const Body<2> body(straight<2>({1, 0, 0}, 10));
  const Eigen::MatrixXd k = dense(body.elastic_stiffness()), m = dense(body.mass());
  std::vector<Eigen::Index> free;  // without the second component of rotations, and the clamp
  for (Eigen::Index i = 2; i < k.rows(); ++i)
    if (i < 22 || (i % 2 == 0 && i > 22)) free.push_back(i);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(k(free, free), m(free, free));
  const Real unit = std::sqrt(modulus * second_moment / (density * area * std::pow(length, 4)));
  EXPECT_NEAR(std::sqrt(modes.eigenvalues()[0]), 1.8751041 * 1.8751041 * unit, 1e-5 * 3.516 * unit);
  EXPECT_NEAR(std::sqrt(modes.eigenvalues()[1]), 4.6940911 * 4.6940911 * unit, 1e-3 * 22 * unit);
}

template <int D>
void check_rigid_motion(const Vector3& direction, const Vector3& spin) {
  const Body<D> body(straight<D>(direction.normalized(), 2));
  NodalColumn moved(body.freedoms(), 0), force(moved), momentum(moved);
  for (std::size_t node = 0; node < 3; ++node) {
    const Vector3 turn = spin.cross(body.mesh().nodes[node]);
    for (std::size_t axis = 0; axis < D; ++axis) {
      moved[node * D + axis] = turn[static_cast<int>(axis)];
      moved[(3 + node) * D + axis] = D == 2 ? (axis == 0 ? spin.z() : 0) : spin[static_cast<int>(axis)];
    }
  }
  body.elastic_stiffness().multiply(moved, 1, force);
  for (const Real one : force) EXPECT_NEAR(one, 0, 1e-6 * modulus * area / length * 1e-6);
  body.mass().multiply(moved, 1, momentum);
  Real twice = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) twice += moved[i] * momentum[i];
  const Real exact = density * area * std::pow(length, 3) / 3 * spin.squaredNorm();
  EXPECT_NEAR(twice, exact, 1e-9 * exact);
  EXPECT_NEAR(body.total_mass(), density * area * length, 1e-9 * density);
}

TEST(beam, bears_nothing_when_it_turns_as_a_whole) {
  check_rigid_motion<2>({1, 2, 0}, {0, 0, 1});
  check_rigid_motion<3>({1, 0, 0}, {0, 2, 1});
  check_rigid_motion<3>({1, 1, 0}, {1, -1, 3});
}

/// Two blocks without mass of their own to speak of, tied by a bar under tension, a spring and a dashpot.
TEST(members, close_the_balance_of_energy) {
  for (const MassMatrix mass : {MassMatrix::consistent, MassMatrix::lumped}) {
    BodyDescription description = straight<2>({0, 1, 0}, 4);
    description.mass = mass;
    description.members[0].damping_ratio = 0.02;
    description.mesh.nodes.push_back({3, 0, 0});
    description.mesh.node_tags.push_back(6);
    MemberSet anchor;
    anchor.name = "anchor";
    anchor.kind = MemberKind::bar;
    anchor.youngs_modulus = modulus;
    anchor.area = 1e-4;
    anchor.density = density;
    anchor.prestress = 1e4;
    anchor.lines = {{5, 4}};
    MemberSet spring{.name = "spring", .kind = MemberKind::spring}, dashpot{.name = "dashpot", .kind = MemberKind::dashpot};
    spring.stiffness = 1e5;
    dashpot.damping = 2e3;
    spring.lines = dashpot.lines = {{5, 2}};
    description.members.insert(description.members.end(), {anchor, spring, dashpot});
    auto body = std::make_unique<Body<2>>(std::move(description));
    Supports<2> supports;
    clamp<2>(*body, 0, supports);
    for (int axis = 0; axis < 2; ++axis) supports.held.push_back({5, axis, Support::no_motion, 0});
    supports.gravity = {0, -9.81};
    FemRules rules;
    rules.step = 1e-3;
    rules.damping = laws::RayleighDamping::make(5, 50);
    FemStepper<2> stepper(std::move(body), supports, rules);
    stepper.relax();
    stepper.start();
    const auto axial = [&] {
      return stepper.body()
          .members()
          .forces(1, stepper.state().displacement, stepper.state().velocity, stepper.state().memory.members)
          .largest_axial;
    };
    const Real at_rest = axial();
    EXPECT_LT(at_rest, 1e4);  // the beam gives way
    EXPECT_GT(at_rest, 0);
    for (int step = 0; step < 20; ++step) stepper.advance();
    EXPECT_NEAR(axial(), at_rest, 1e-7 * at_rest);
    NodalColumn blow(stepper.body().mesh().nodes.size() * 2, 0);
    blow[8] = 3e3;
    stepper.apply(blow);
    for (int step = 0; step < 300; ++step) stepper.advance();
    EXPECT_GT(stepper.work().damping, 0.01 * std::abs(stepper.work().loads));
    EXPECT_NEAR(stepper.energy_residual(), 0, 1e-8 * std::abs(stepper.work().loads));
  }
}

/// Bars along the edge of ground that is pulled: both stretch as one.
TEST(members, share_the_load_with_the_ground) {
  const auto mesh = test::box(test::ElementShape::quadrilateral4, {{1, 2, 1}, {1, 2, 1}, 0});
  BodyDescription description = test::of_one_material(mesh, SolidMaterial::elastic_of(1e7, 0, 2000));
  MemberSet bars;
  bars.name = "bars";
  bars.kind = MemberKind::bar;
  bars.youngs_modulus = 1e9;
  bars.area = 2e-2;
  for (const Real x : {0.0, 1.0})
    for (const Real y : {0.0, 1.0}) bars.lines.push_back({test::node_at(mesh, {x, y, 0}), test::node_at(mesh, {x, y + 1, 0})});
  description.members = {bars};
  Supports<2> supports;
  for (int axis = 0; axis < 2; ++axis) test::hold<2>(mesh, "bottom", axis, supports);
  supports.loads = {{"pull", test::traction(mesh, "top", {0, 1e5, 0}), 0}};
  FemStepper<2> stepper(std::make_unique<Body<2>>(std::move(description)), supports, statics());
  stepper.start();
  stepper.advance();
  const Real strain = 1e5 / (1e7 + 2 * 1e9 * 2e-2);
  const auto top = static_cast<std::size_t>(test::node_at(mesh, {0, 2, 0}));
  EXPECT_NEAR(stepper.state().displacement[2 * top + 1], 2 * strain, 1e-9 * strain);
  EXPECT_NEAR(stepper.body()
                  .members()
                  .forces(0, stepper.state().displacement, stepper.state().velocity, stepper.state().memory.members)
                  .largest_axial,
              1e9 * 2e-2 * strain, 1e-3);
}

TEST(members, need_lines_with_a_length) {
  BodyDescription description = straight<2>({1, 0, 0}, 1);
  description.members[0].lines = {{0, 0}};
  EXPECT_THROW(Body<2>(std::move(description)), UserError);
}

}  // namespace
}  // namespace sazare::methods::fem
