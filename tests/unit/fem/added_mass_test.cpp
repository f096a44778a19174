#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/wet_faces.hpp"
#include "tests/support/element_boxes.hpp"
#include "tests/support/still_water.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;
using test::water_at, test::water_density;

/// Water of a depth of 2 m on the left side of a box: its mass, and the moment of the masses about the level.
template <int D>
std::pair<Real, Real> mass_on_the_left(ElementShape shape, int cells, MassMatrix kind) {
  const auto mesh =
      test::box(shape, D == 2 ? test::BoxRules{{1, 2, 0}, {1, cells, 1}, 0} : test::BoxRules{{1, 0.7, 2}, {1, 2, cells}, 0});
  Real mass = 0, moment = 0;
  for (const auto& face : mesh.find_group("left")->elements) {
    const Eigen::MatrixXd matrix = added_mass<D>(mesh, face, water_at(2, D), water_density, 2, kind);
    EXPECT_EQ(matrix, matrix.transpose());
    for (Eigen::Index row = 0; row < matrix.rows(); ++row)
      for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
        const Real y = 2 - mesh.nodes[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(row / D)])][D - 1];
        if (row % D == 0 && column % D == 0) {
          mass += matrix(row, column);
          moment += y * matrix(row, column);
        }
        if (row % D != 0 || column % D != 0) {
          EXPECT_EQ(matrix(row, column), 0);
        }  // nothing along the face
      }
  }
  return {mass, moment};
}

TEST(added_mass, is_the_area_of_the_parabola_of_westergaard) {
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    const Real width = D == 2 ? 1 : 0.7, exact = 7.0 / 12 * water_density * 4 * width, arm = 7.0 / 20 * water_density * 8 * width;
    for (const MassMatrix kind : {MassMatrix::consistent, MassMatrix::lumped}) {
      const auto [mass, moment] = mass_on_the_left<D>(shape, 8, kind);
      EXPECT_NEAR(mass, exact, 4e-4 * exact) << test::name_of(shape);
      EXPECT_NEAR(moment, arm, (kind == MassMatrix::consistent ? 4e-4 : 1e-2) * arm) << test::name_of(shape);
    }
  });
}

TEST(added_mass, converges_as_the_root_at_the_surface_allows) {
  const Real exact = 7.0 / 12 * water_density * 4;
  const auto error = [&](int cells) {
    return std::abs(mass_on_the_left<2>(ElementShape::quadrilateral4, cells, MassMatrix::consistent).first - exact);
  };
  EXPECT_NEAR(std::log2(error(4) / error(8)), 1.5, 0.1);
  EXPECT_NEAR(std::log2(error(8) / error(16)), 1.5, 0.1);
}

/// A wall on a soft layer without mass, which moves along x only: an oscillator.
Real swing(bool with_water, MassMatrix kind, int steps, Real step) {
  auto mesh = test::box(ElementShape::quadrilateral8, {{1, 3, 0}, {1, 24, 1}, 0});
  auto description = test::of_one_material(mesh, SolidMaterial::elastic_of(1e12, 0, 2400));
  description.materials.push_back(SolidMaterial::elastic_of(2e7, 0, 1e-6));  // G = 1e7
  description.mass = kind;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    Real low = 3;
    for (const Index node : mesh.elements[e].node_list()) low = std::min(low, mesh.nodes[static_cast<std::size_t>(node)].y());
    if (low < 0.99) description.material[e] = 1;
  }
  Supports<2> supports;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    supports.held.push_back({static_cast<Index>(node), 1, Support::no_motion, 0});
  test::hold<2>(mesh, "bottom", 0, supports);
  supports.gravity.x() = 1;
  if (with_water) {
    StillWater<2> water;
    water.pressure.force.resize(mesh.nodes.size() * 2, 0);
    for (const auto& face : mesh.find_group("left")->elements) {
      const Eigen::MatrixXd mass = added_mass<2>(mesh, face, water_at(2.5, 2), water_density, 1.5, kind);
      Real lowest = 3;
      for (const Index node : face.node_list()) lowest = std::min(lowest, mesh.nodes[static_cast<std::size_t>(node)].y());
      if (lowest > 0.99 && !mass.isZero(0)) water.moving.push_back({{face.node_list().begin(), face.node_list().end()}, mass});
    }
    supports.waters = {water};
  }
  FemRules rules;
  rules.step = step;
  FemStepper<2> stepper(std::make_unique<Body<2>>(std::move(description)), std::move(supports), rules);
  stepper.start();
  for (int i = 0; i < steps; ++i) stepper.advance();
  EXPECT_NEAR(stepper.energy_residual(), 0, 1e-8 * stepper.work().gravity);
  if (with_water) {
    EXPECT_NEAR(stepper.kinetic_energy_of_water() / stepper.kinetic_energy(), 0.2147, 2e-3);
  }
  return stepper.state().displacement[static_cast<std::size_t>(test::node_at(mesh, {0, 3, 0})) * 2];
}

TEST(added_mass, lengthens_the_period_of_a_stiff_wall_on_a_soft_base) {
  const Real wall = 2400 * 2, step = 2e-3;
  const Real stiffness = 1 / (1e-7 + 2 / (3 * 5e11));  // of the layer, and of the wall in shear under its own inertia
  for (const MassMatrix kind : {MassMatrix::consistent, MassMatrix::lumped})
    for (const bool with_water : {false, true}) {
      const Real mass = wall + (with_water ? 7.0 / 12 * water_density * 1.5 * 1.5 : 0);
      const Real omega = 2 / step * std::atan(0.5 * step * std::sqrt(stiffness / mass));  // as Newmark's step has it
      const int steps = static_cast<int>(4.25 * 2 * std::numbers::pi / (omega * step));   // where the motion is fastest
      const Real exact = wall / stiffness * (1 - std::cos(omega * step * steps));
      EXPECT_NEAR(swing(with_water, kind, steps, step), exact, (with_water ? 3e-3 : 1e-4) * wall / stiffness);
    }
}

}  // namespace
}  // namespace sazare::methods::fem
