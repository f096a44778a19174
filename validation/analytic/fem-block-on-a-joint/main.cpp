#include <cmath>

#include "sazare/core/error.hpp"
#include "tests/support/element_boxes.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using namespace sazare::methods::fem;

constexpr Real friction = 0.5, gravity = 9.81;

/// A block of 1 m x 0.5 m on a joint over elastic ground, under gravity at an angle with this tangent.
methods::fem::FemStepper<2> block(Real slope) {
  auto mesh = test::box(geometry::ElementShape::quadrilateral4, {{1, 1, 1}, {4, 4, 1}, 0});
  mesh.region_names = {"ground", "block"};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    Real height = 0;
    for (const Index node : mesh.elements[e].node_list()) height += 0.25 * mesh.nodes[static_cast<std::size_t>(node)].y();
    mesh.region[e] = height > 0.5 ? 1 : 0;
  }
  const auto faces = geometry::split(mesh, {geometry::faces_between(mesh, 0, 1)});
  Supports<2> supports;
  for (int axis = 0; axis < 2; ++axis) test::hold<2>(mesh, "bottom", axis, supports);
  supports.gravity = gravity * Vector<2>(std::sin(std::atan(slope)), -std::cos(std::atan(slope)));
  auto description = test::of_one_material(mesh, SolidMaterial::elastic_of(1e8, 0.2, 2000));
  description.joints = {{"base", {1e10, 1e10, 0, friction}, faces.front()}};
  methods::fem::FemRules rules;
  rules.step = 1e-3;
  rules.most_cuts = 6;
  rules.damping = {0, 1e-3};  // of the stiffness alone: vibrations of the block would let it slide more easily
  description.materials[0].damping_ratio = 1;
  return methods::fem::FemStepper<2>(std::make_unique<Body<2>>(std::move(description)), std::move(supports), rules);
}

bool stands(Real slope) {
  auto stepper = block(slope);
  try {
    stepper.relax();
    return true;
  } catch (const PhysicsError&) {
    return false;
  }
}

}  // namespace

int main() {
  Real low = 0.3, high = 0.7;
  while (high - low > 2e-3) (stands(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  validation::print_row("angle", 0.5 * (low + high));
  auto rests = block(0);
  rests.relax();
  rests.start();
  const auto& state = rests.state();
  validation::print_row("reaction",
                        rests.body().joints().summary(0, state.displacement, state.memory.joints).force.y() / (1000 * gravity));
  auto slides = block(0.7);
  slides.start();
  const auto top = static_cast<std::size_t>(test::node_at(slides.body().mesh(), {0.5, 1, 0})) * 2;
  for (int step = 0; step < 250; ++step) slides.advance();  // until the sudden gravity has died out
  const Real before = slides.state().velocity[top];
  for (int step = 0; step < 250; ++step) slides.advance();
  const Real gained = slides.state().velocity[top] - before;
  validation::print_row("sliding", gained / (0.25 * gravity * std::cos(std::atan(0.7)) * (0.7 - friction)));
}
