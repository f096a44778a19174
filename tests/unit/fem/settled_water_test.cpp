#include <gtest/gtest.h>

#include <cmath>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/wet_faces.hpp"
#include "tests/support/element_boxes.hpp"
#include "tests/support/still_water.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;
using test::gravity, test::press, test::unit_weight, test::water_at, test::water_density;

/// A block under water that weighs as much as it displaces.
FemStepper<2> afloat(Real weight_over_buoyancy, bool statics) {
  const auto mesh = test::box(ElementShape::quadrilateral8, {{4, 2, 0}, {6, 3, 1}, 0.2});
  Supports<2> supports;
  supports.gravity.y() = -gravity;
  StillWater<2> water;
  for (const auto& group : mesh.groups) press<2>(mesh, group.name, water_at(7, 2), water);
  supports.waters = {water};
  const Index one = test::node_at(mesh, {0, 0, 0}), other = test::node_at(mesh, {4, 0, 0});
  supports.held = {{one, 0, Support::no_motion, 0}, {one, 1, Support::no_motion, 0}, {other, 1, Support::no_motion, 0}};
  FemRules rules;
  rules.step = 1e-2;
  rules.statics = statics;
  rules.tolerance = 1e-12;
  return FemStepper<2>(std::make_unique<Body<2>>(test::of_one_material(
                           mesh, SolidMaterial::elastic_of(1e9, 0.2, weight_over_buoyancy * water_density))),
                       std::move(supports), rules);
}

TEST(settled_under_water, a_body_floats_or_presses_with_its_effective_weight_and_stays_at_rest) {
  for (const bool statics : {true, false})
    for (const Real ratio : {1.0, 2.4}) {
      auto stepper = afloat(ratio, statics);
      stepper.relax();
      stepper.start();
      const Real weight = ratio * unit_weight * 8;
      const auto first = stepper.state().displacement;
      for (int step = 0; step < 20; ++step) stepper.advance();
      Real reaction = 0;
      for (const Support& support : stepper.supports().held)
        if (support.axis == 1) reaction += stepper.reactions()[number<2>(support.node, 1)];
      EXPECT_NEAR(reaction, weight - unit_weight * 8, 1e-9 * weight);
      Real moved = 0, most = 0;
      for (std::size_t i = 0; i < first.size(); ++i) {
        moved = std::max(moved, std::abs(stepper.state().displacement[i] - first[i]));
        most = std::max(most, std::abs(first[i]));
      }
      EXPECT_GT(most, 0);
      EXPECT_LT(moved, 1e-9 * most);
      EXPECT_LT(std::abs(stepper.work().water), 1e-9 * weight * most);
    }
}

/// The upper half of a box on a joint in its middle, of 1 m2, with water in the joint of one level or two, pushed aside by a body
/// force. The lower half is held.
FemStepper<2> on_a_wet_joint(Real level, Real far_level, Real push) {
  auto mesh = test::box(ElementShape::quadrilateral4, {{4, 1, 0}, {4, 4, 1}, 0});
  mesh.region_names = {"lower", "upper"};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    mesh.region[e] = mesh.nodes[static_cast<std::size_t>(mesh.elements[e].nodes[0])].y() > 0.49 ? 1 : 0;
  const auto faces = geometry::split(mesh, {geometry::faces_between(mesh, 0, 1)});
  auto description = test::of_one_material(mesh, SolidMaterial::elastic_of(1e10, 0.2, 2000));
  description.joints = {{"joint", {1e10, 1e10, 0, 0.5}, faces.front()}};
  laws::WaterPressure water = water_at(level, 2);
  water.slope = Vector3::UnitX() * (far_level - level) / 4;
  StillWater<2> uplift;
  uplift.pressure.force.resize(mesh.nodes.size() * 2, 0);
  for (const auto& face : faces.front()) {
    const Eigen::VectorXd force = pressure_force<2>(mesh, face.first, water);
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      uplift.pressure.force[number<2>(face.first.nodes[static_cast<std::size_t>(i / 2)], static_cast<int>(i % 2))] += force[i];
      uplift.pressure.force[number<2>(face.second.nodes[static_cast<std::size_t>(i / 2)], static_cast<int>(i % 2))] -= force[i];
    }
  }
  Supports<2> supports;
  for (int axis = 0; axis < 2; ++axis) test::hold<2>(mesh, "bottom", axis, supports);
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    if (mesh.nodes[node].y() < 0.49)
      for (int axis = 0; axis < 2; ++axis) supports.held.push_back({static_cast<Index>(node), axis, Support::no_motion, 0});
  supports.gravity = {push, -gravity};
  supports.waters = {uplift};
  FemRules rules;
  rules.step = 1;
  rules.statics = true;
  return FemStepper<2>(std::make_unique<Body<2>>(std::move(description)), std::move(supports), rules);
}

TEST(water_in_a_joint, lets_a_block_slide_when_the_friction_of_its_effective_weight_is_exceeded) {
  const Real mass = 2000 * 4 * 0.5;
  for (const Real far_level : {1.0, 0.7, 0.2}) {
    // Heads above the joint at 0.5 m, from 0.5 m at the left to far_level - 0.5.
    const Real uplift =
        unit_weight * (far_level > 0.5 ? 0.5 * (0.5 + far_level - 0.5) * 4 : 0.5 * 0.5 * 4 * 0.5 / (1.0 - far_level));
    const Real limit = 0.5 * (mass * gravity - uplift) / mass;
    auto stands = on_a_wet_joint(1, far_level, 0.999 * limit);
    stands.relax();
    const auto found = stands.body().joints().summary(0, stands.state().displacement, stands.state().memory.joints);
    EXPECT_NEAR(found.force.y(), mass * gravity - uplift, 1e-6 * mass * gravity);
    EXPECT_NEAR(found.force.x(), -0.999 * limit * mass, 1e-6 * mass * gravity);
    EXPECT_THROW(on_a_wet_joint(1, far_level, 1.001 * limit).relax(), std::exception);
  }
}

}  // namespace
}  // namespace sazare::methods::fem
