#include <gtest/gtest.h>

#include <numbers>
#include <optional>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/wet_faces.hpp"
#include "tests/support/element_boxes.hpp"
#include "tests/support/still_water.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;
using test::gravity, test::press, test::unit_weight, test::water_at, test::water_density;

/// A column 8 m high under its weight, whose sides do not move aside; the water stands at this level, above the column also on
/// its top.
template <int D>
FemStepper<D> wet_column(ElementShape shape, Real level, bool weak) {
  const auto mesh = test::box(shape, D == 2 ? test::BoxRules{{1, 8, 0}, {1, 8, 1}, 0} : test::BoxRules{{1, 1, 8}, {1, 1, 8}, 0});
  SolidMaterial ground = SolidMaterial::elastic_of(5e7, 0.2, 1700);
  ground.saturation = {2050, water_at(level, D)};
  if (weak) ground.strength = laws::MohrCoulomb::make(0, std::numbers::pi / 6, 0, std::nullopt);
  Supports<D> supports;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    for (int axis = 0; axis < D - 1; ++axis) supports.held.push_back({static_cast<Index>(node), axis, Support::no_motion, 0});
  test::hold<D>(mesh, "bottom", D - 1, supports);
  supports.gravity[D - 1] = -gravity;
  StillWater<D> above;
  press<D>(mesh, "top", water_at(level, D), above);
  supports.waters = {above};
  FemRules rules;
  rules.step = 0.01;
  rules.tolerance = 1e-10;
  return FemStepper<D>(std::make_unique<Body<D>>(test::of_one_material(mesh, ground)), std::move(supports), rules);
}

TEST(saturated_ground, bears_its_effective_weight_and_yields_by_effective_stress) {
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    if (shape != ElementShape::triangle6 && shape != ElementShape::quadrilateral8 && shape != ElementShape::hexahedron8) return;
    for (const Real level : {-1.0, 5.0, 8.0, 11.0})
      for (const bool weak : {false, true}) {
        auto stepper = wet_column<D>(shape, level, weak);
        stepper.relax();
        const auto& mesh = stepper.body().mesh();
        const auto means = stepper.body().means(stepper.state().displacement, stepper.state().memory);
        const auto pores = stepper.body().pore_pressures();
        for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
          Real z = 0;  // mean over the corners
          const auto corners = static_cast<std::size_t>(geometry::facts(mesh.elements[e].shape).corners);
          for (std::size_t i = 0; i < corners; ++i)
            z += mesh.nodes[static_cast<std::size_t>(mesh.elements[e].nodes[i])][D - 1] / static_cast<Real>(corners);
          const Real wet = std::max(std::min(level, 8.0) - z, 0.0), dry = 8 - z - wet;
          const Real effective = gravity * (1700 * dry + (2050 - water_density) * wet);
          const Real scale = gravity * 2050 * 8;
          EXPECT_NEAR(means[e].stress[D - 1], -effective, 1e-8 * scale) << test::name_of(shape) << level << ' ' << z;
          // At rest sideways stress is nu/(1 - nu) = 1/4; with 30 degrees no less than 1/3.
          EXPECT_NEAR(means[e].stress[0], -effective / (weak ? 3 : 4), 1e-8 * scale) << test::name_of(shape) << level << ' ' << z;
          EXPECT_NEAR(pores[e], unit_weight * std::max(level - z, 0.0), 1e-9 * scale);
        }
      }
  });
}

TEST(saturated_ground, stays_at_rest_and_its_base_bears_ground_and_water) {
  auto stepper = wet_column<2>(ElementShape::quadrilateral8, 11, false);
  stepper.relax();
  stepper.start();
  const auto first = stepper.state().displacement;
  for (int step = 0; step < 10; ++step) stepper.advance();
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NEAR(stepper.state().displacement[i], first[i], 1e-9);
  Real base = 0;
  for (const Support& support : stepper.supports().held)
    if (support.axis == 1) base += stepper.reactions()[number<2>(support.node, 1)];
  // The supports at the foot bear the effective weight; the water in the pores stands on them as well.
  EXPECT_NEAR(base, gravity * 8 * 2050 + unit_weight * 3, 1e-8 * gravity * 8 * 2050);
  EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9);
}

}  // namespace
}  // namespace sazare::methods::fem
