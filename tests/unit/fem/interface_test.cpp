#include <gtest/gtest.h>

#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

const laws::CoulombInterface law{1e8, 5e7, 100, 0.5};

TEST(interface_law, sticks_slips_and_opens) {
  const Vector<2> normal(0, 1), none(0, 0);
  const auto sticks = laws::respond<2>(law, {1e-6, -1e-5}, normal, none);
  EXPECT_EQ(sticks.state, laws::InterfaceState::sticks);
  EXPECT_NEAR(sticks.force.y(), -1e3, 1e-9);
  EXPECT_NEAR(sticks.force.x(), 50, 1e-9);
  const auto slips = laws::respond<2>(law, {1e-3, -1e-5}, normal, none);
  EXPECT_EQ(slips.state, laws::InterfaceState::slips);
  EXPECT_NEAR(slips.force.x(), 100 + 0.5 * 1e3, 1e-9);
  EXPECT_NEAR(slips.slip.x(), 1e-3 - 600 / 5e7, 1e-12);
  const auto open = laws::respond<2>(law, {1e-3, 1e-6}, normal, none);
  EXPECT_EQ(open.state, laws::InterfaceState::open);
  EXPECT_EQ(open.force.norm(), 0);
}

TEST(interface_law, force_is_the_derivative_of_the_energy_and_tangent_that_of_the_force) {
  const Vector3 normal = Vector3(1, 2, 2) / 3;
  for (const Real along : {1e-7, 1e-3}) {  // sticks, slips
    const Vector3 at = -1e-5 * normal + along * Vector3(2, -1, 0).normalized();
    const auto here = laws::respond<3>(law, at, normal, Vector3::Zero());
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 step = 1e-11 * Vector3::Unit(axis);
      const auto more = laws::respond<3>(law, at + step, normal, Vector3::Zero()),
                 less = laws::respond<3>(law, at - step, normal, Vector3::Zero());
      if (here.state == laws::InterfaceState::sticks) {
        EXPECT_NEAR((more.energy - less.energy) / 2e-11, here.force[axis], 1e-2);
      }
      EXPECT_LT(((more.force - less.force) / 2e-11 - here.tangent.col(axis)).norm(), 1e4);
    }
  }
}

/// Two bars, one on the other, with a joint between; the upper half is region 1.
BodyDescription two_blocks(ElementShape shape, Real friction) {
  auto mesh = test::box(shape, {{1, 1, 1}, {2, 2, 2}, 0});
  const int up = mesh.dimension - 1;
  mesh.region_names = {"lower", "upper"};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    Real height = 0;
    for (const Index node : mesh.elements[e].node_list()) height += mesh.nodes[static_cast<std::size_t>(node)][up];
    mesh.region[e] = height / static_cast<Real>(mesh.elements[e].node_list().size()) > 0.5 ? 1 : 0;
  }
  const auto faces = geometry::split(mesh, {geometry::faces_between(mesh, 0, 1)});
  auto description = test::of_one_material(mesh, SolidMaterial::elastic_of(1e8, 0.2, 2000));
  description.joints = {{"joint", {1e10, 1e10, 0, friction}, faces.front()}};
  return description;
}

TEST(split, gives_each_side_nodes_of_its_own) {
  for (const ElementShape shape : {ElementShape::triangle6, ElementShape::quadrilateral4, ElementShape::hexahedron20}) {
    const auto whole = test::box(shape, {{1, 1, 1}, {2, 2, 2}, 0});
    const auto body = two_blocks(shape, 0.5);
    std::size_t on_it = 0;
    for (const Vector3& node : whole.nodes) on_it += std::abs(node[whole.dimension - 1] - 0.5) < 1e-9 ? 1 : 0;
    EXPECT_EQ(body.mesh.nodes.size(), whole.nodes.size() + on_it);
  }
}

TEST(split, leaves_the_end_of_a_cut_inside_the_body_one_node) {
  auto mesh = test::box(ElementShape::quadrilateral4, {{2, 2, 0}, {2, 2, 1}, 0});
  // The cut goes from the left side to the centre.
  geometry::SharedFace face;
  for (const auto& shared : geometry::faces_of_group(
           mesh, {"cut", 1, {{ElementShape::line2, {test::node_at(mesh, {0, 1, 0}), test::node_at(mesh, {1, 1, 0})}, 0}}}))
    face = shared;
  const std::size_t before = mesh.nodes.size();
  const auto faces = geometry::split(mesh, {{face}});
  EXPECT_EQ(mesh.nodes.size(), before + 1);
  int own = 0;
  for (std::size_t i = 0; i < 2; ++i) own += faces[0][0].first.nodes[i] != faces[0][0].second.nodes[i] ? 1 : 0;
  EXPECT_EQ(own, 1);
}

/// Gravity inclined by an angle: the ratio of its parts is the tangent.
template <int D>
methods::fem::FemStepper<D> inclined(ElementShape shape, Real slope, Real friction) {
  auto description = two_blocks(shape, friction);
  Supports<D> supports;
  for (int axis = 0; axis < D; ++axis) test::hold<D>(description.mesh, "bottom", axis, supports);
  supports.gravity[0] = 9.81 * std::sin(std::atan(slope));
  supports.gravity[D - 1] = -9.81 * std::cos(std::atan(slope));
  methods::fem::FemRules rules;
  rules.step = 1e-3;
  rules.damping = {0, 1e-3};  // of the stiffness alone: vibrations of the block would let it slide more easily
  description.materials[0].damping_ratio = 1;
  return methods::fem::FemStepper<D>(std::make_unique<Body<D>>(std::move(description)), std::move(supports), rules);
}

TEST(block_on_a_joint, stands_below_the_angle_of_friction_and_its_reaction_is_its_weight) {
  auto stepper = inclined<2>(ElementShape::quadrilateral8, 0.49, 0.5);
  stepper.relax();
  stepper.start();
  const auto found = stepper.body().joints().summary(0, stepper.state().displacement, stepper.state().memory.joints);
  EXPECT_NEAR(found.force.x(), -1000 * stepper.supports().gravity.x(), 1e-6 * 9810);
  EXPECT_NEAR(found.force.y(), -1000 * stepper.supports().gravity.y(), 1e-6 * 9810);
}

TEST(block_on_a_joint, slides_above_it_with_the_acceleration_that_is_left) {
  auto stepper = inclined<2>(ElementShape::quadrilateral4, 0.6, 0.5);
  EXPECT_THROW(stepper.relax(), std::exception);
  auto slides = inclined<2>(ElementShape::quadrilateral4, 0.6, 0.5);
  slides.start();
  const auto top = static_cast<std::size_t>(test::node_at(slides.body().mesh(), {0.5, 1, 0})) * 2;
  for (int step = 0; step < 150; ++step) slides.advance();  // until the sudden gravity has died out
  const Real before = slides.state().velocity[top];
  for (int step = 0; step < 150; ++step) slides.advance();
  const Real cosine = std::cos(std::atan(0.6)), left = 9.81 * cosine * (0.6 - 0.5);
  EXPECT_NEAR(slides.state().velocity[top] - before, left * 0.15, 0.01 * left * 0.15);
  EXPECT_GT(slides.work().friction, 0);
}

TEST(block_on_a_joint, is_lifted_without_resistance) {
  auto description = two_blocks(ElementShape::hexahedron8, 0.5);
  Supports<3> supports;
  for (int axis = 0; axis < 3; ++axis) test::hold<3>(description.mesh, "bottom", axis, supports);
  supports.gravity.z() = 5;
  methods::fem::FemRules rules;
  rules.step = 1e-3;
  methods::fem::FemStepper<3> stepper(std::make_unique<Body<3>>(std::move(description)), std::move(supports), rules);
  stepper.start();
  for (int step = 0; step < 100; ++step) stepper.advance();
  const Index top = test::node_at(stepper.body().mesh(), {0.5, 0.5, 1});
  EXPECT_NEAR(stepper.state().velocity[static_cast<std::size_t>(top) * 3 + 2], 5 * 0.1, 0.02 * 0.5);
  EXPECT_EQ(stepper.body().joints().summary(0, stepper.state().displacement, stepper.state().memory.joints).open_fraction, 1);
}

}  // namespace
}  // namespace sazare::methods::fem
