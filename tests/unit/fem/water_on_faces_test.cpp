#include <gtest/gtest.h>

#include <cmath>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/wet_faces.hpp"
#include "tests/support/element_boxes.hpp"
#include "tests/support/still_water.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;
using test::press, test::unit_weight, test::water_at;

/// Force of the nodes, and its moment about the origin.
template <int D>
std::pair<Vector3, Vector3> resultant(const ElementMesh& mesh, const StillWater<D>& water) {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    Vector3 part = Vector3::Zero();
    for (int axis = 0; axis < D; ++axis) part[axis] = water.pressure.force[node * D + static_cast<std::size_t>(axis)];
    force += part;
    moment += mesh.nodes[node].cross(part);
  }
  return {force, moment};
}

/// A box of 1 x 2 m, in space 1 x 0.7 x 2 m, whose left face leans over by `lean` metres per metre of height.
ElementMesh leaning(ElementShape shape, Real lean) {
  const bool flat = geometry::facts(shape).dimension == 2;
  auto mesh = test::box(shape, flat ? test::BoxRules{{1, 2, 0}, {2, 3, 1}, 0} : test::BoxRules{{1, 0.7, 2}, {2, 2, 3}, 0});
  for (Vector3& node : mesh.nodes) node.x() += lean * node[mesh.dimension - 1];
  return mesh;
}

TEST(water, presses_on_vertical_inclined_and_half_wet_walls_with_the_force_and_moment_of_the_triangle) {
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    for (const Real lean : {0.0, 0.6, -0.35})
      for (const Real level : {0.3, 1.37, 2.0, 5.0}) {
        const ElementMesh mesh = leaning(shape, lean);
        StillWater<D> water;
        press<D>(mesh, "left", water_at(level, D), water);
        const auto [force, moment] = resultant<D>(mesh, water);
        // p = w (level - z) from z = 0 to the top of the water or of the wall, x = lean z, dF = p (1, -lean) dz: right and down.
        const Real width = D == 2 ? 1 : 0.7, top = std::min(level, 2.0);
        const Real sum = unit_weight * width * (level * top - top * top / 2);
        const Real first = unit_weight * width * (level * top * top / 2 - top * top * top / 3);
        EXPECT_NEAR(force.x(), sum, 1e-12 * sum) << test::name_of(shape) << lean << ' ' << level;
        EXPECT_NEAR(force[D - 1], -lean * sum, 1e-12 * sum);
        const Real about = D == 2 ? -moment.z() : moment.y();  // z F_x - x F_z
        EXPECT_NEAR(about, (1 + lean * lean) * first, 1e-12 * std::max(first, sum))
            << test::name_of(shape) << lean << ' ' << level;
        EXPECT_LT((force.template head<D>() - water.force).norm(), 1e-12 * sum);
      }
  });
}

TEST(water, lifts_a_submerged_block_by_the_weight_of_the_water_it_displaces) {
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    const ElementMesh mesh = test::box(shape, {{1.3, 0.7, 0.9}, {2, 2, 2}, 0.2});
    StillWater<D> water;
    for (const auto& group : mesh.groups) press<D>(mesh, group.name, water_at(3, D), water);
    const auto [force, moment] = resultant<D>(mesh, water);
    const Real weight = unit_weight * 1.3 * 0.7 * (D == 2 ? 1 : 0.9);
    Vector3 lift = Vector3::Zero();
    lift[D - 1] = weight;
    EXPECT_LT((force - lift).norm(), 1e-11 * weight) << test::name_of(shape);
    EXPECT_LT((moment - Vector3(0.65, 0.35, D == 2 ? 0 : 0.45).cross(lift)).norm(), 1e-11 * weight) << test::name_of(shape);
  });
}

TEST(water, pushes_a_curved_wall_as_its_projection) {
  for (const ElementShape shape : {ElementShape::triangle6, ElementShape::quadrilateral9})
    for (const Real level : {0.8, 1.21, 2.0}) {
      auto mesh = leaning(shape, 0);
      for (Vector3& node : mesh.nodes) node.x() += 0.2 * std::sin(2.5 * node.y());
      StillWater<2> water;
      press<2>(mesh, "left", water_at(level, 2), water);
      EXPECT_NEAR(water.force.x(), unit_weight * level * level / 2, 1e-12 * unit_weight * level * level);
    }
}

TEST(water, on_faces_that_are_no_parallelograms_is_found_to_some_1e_8) {
  for (const ElementShape shape : {ElementShape::hexahedron8, ElementShape::hexahedron20, ElementShape::hexahedron27})
    for (const Real level : {0.8, 1.21}) {
      auto mesh = leaning(shape, 0);
      for (Vector3& node : mesh.nodes)
        node.z() *= 1 + 0.4 * (node.y() / 0.7 - 0.5) * (2 - node.z());  // quadrilaterals of the side
      if (geometry::facts(shape).quadratic) continue;                   // their sides are no longer straight
      StillWater<3> water;
      press<3>(mesh, "left", water_at(level, 3), water);
      const Real sum = unit_weight * 0.7 * level * level / 2;
      EXPECT_NEAR(water.force.x(), sum, 1e-8 * sum);
      const auto [force, moment] = resultant<3>(mesh, water);
      EXPECT_NEAR(moment.y(), sum * level / 3, 1e-8 * sum);
      EXPECT_NEAR(moment.z(), -sum * 0.35, 1e-8 * sum);
    }
}

/// Under a base the pressure falls from one level to the other, and is 0 where the level is below the base.
TEST(uplift, is_a_trapezium_and_where_the_level_falls_below_the_base_a_triangle) {
  for (const ElementShape shape : {ElementShape::triangle3, ElementShape::quadrilateral8}) {
    const ElementMesh mesh = test::box(shape, {{4, 1, 0}, {5, 2, 1}, 0});
    laws::WaterPressure water = water_at(3, 2);
    water.slope = Vector3::UnitX() * (1.0 - 3.0) / 4;
    StillWater<2> trapezium;
    press<2>(mesh, "bottom", water, trapezium);
    const Real lift = unit_weight * 4 * 2;
    EXPECT_NEAR(trapezium.force.y(), lift, 1e-12 * lift);
    EXPECT_NEAR(resultant<2>(mesh, trapezium).second.z(), unit_weight * (4 * 1 * 2 + 0.5 * 4 * 2 * 4 / 3), 1e-12 * 4 * lift);
    water.slope = Vector3::UnitX() * (-1.5 - 3.0) / 4;  // 0 at x = 8/3
    StillWater<2> triangle;
    press<2>(mesh, "bottom", water, triangle);
    EXPECT_NEAR(triangle.force.y(), unit_weight * 0.5 * 3 * 8 / 3, 1e-12 * lift);
    EXPECT_NEAR(resultant<2>(mesh, triangle).second.z(), unit_weight * 0.5 * 3 * 8 / 3 * 8 / 9, 1e-12 * 4 * lift);
  }
}

}  // namespace
}  // namespace sazare::methods::fem
