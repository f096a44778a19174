#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

constexpr Real unit_weight = 9810, water_bulk = 2.2e9, porosity = 0.4;

/// Saturated to a water table far above, so that no node is at it, and without weight.
SolidMaterial saturated(Real youngs_modulus, Real poisson_ratio, Real conductivity, int dimension, Real bulk = water_bulk) {
  auto material = SolidMaterial::elastic_of(youngs_modulus, poisson_ratio, 1600);
  material.saturation = Saturation{2000, {0, dimension - 1, 100}, PoreFlow{porosity / bulk, conductivity / unit_weight}};
  return material;
}

std::vector<Index> nodes_of(const ElementMesh& mesh, const std::string& group) {
  std::vector<Index> nodes;
  for (const auto& face : mesh.find_group(group)->elements)
    nodes.insert(nodes.end(), face.node_list().begin(), face.node_list().end());
  return nodes;
}

/// Sides and bottom on rollers, a pressure on the top.
template <int D>
Supports<D> in_a_box(const ElementMesh& mesh, Real pressure) {
  Supports<D> supports;
  test::hold<D>(mesh, "left", 0, supports);
  test::hold<D>(mesh, "right", 0, supports);
  test::hold<D>(mesh, "bottom", D - 1, supports);
  if constexpr (D == 3) {
    test::hold<D>(mesh, "front", 1, supports);
    test::hold<D>(mesh, "back", 1, supports);
  }
  Vector3 traction = Vector3::Zero();
  traction[D - 1] = -pressure;
  supports.loads.push_back({"load", test::traction(mesh, "top", traction), 0});
  return supports;
}

template <int D>
FemStepper<D> stepper_of(ElementMesh mesh, const SolidMaterial& material, Supports<D> supports, const FemRules& rules) {
  return {std::make_unique<Body<D>>(test::of_one_material(std::move(mesh), material)), std::move(supports), rules};
}

/// The excess pressure of Terzaghi's layer at a depth under its drained top, over the load.
Real terzaghi(Real depth, Real height, Real time_factor) {
  Real sum = 0;
  for (int m = 0; m < 200; ++m) {
    const Real n = std::numbers::pi / 2 * (2 * m + 1);
    sum += 2 / n * std::sin(n * depth / height) * std::exp(-n * n * time_factor);
  }
  return sum;
}

TEST(pores, carry_a_load_at_once_where_they_have_no_drainage) {
  // Skempton: confined, p = load / (1 + M S), M the constrained modulus, S = n/K_w the compressibility of the pores.
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    const ElementMesh mesh = test::box(shape, D == 2 ? test::BoxRules{{1, 2, 0}, {2, 3, 1}, 0.2} : test::BoxRules{{1, 1, 2}, {2, 2, 2}, 0.2});
    const SolidMaterial ground = saturated(3e7, 0.25, 0, D, 1e8);
    const Real modulus = ground.elastic.lame + 2 * ground.elastic.shear_modulus;
    const Real pressure = 5e4, share = 1 / (1 + modulus * porosity / 1e8);
    auto stepper = stepper_of<D>(mesh, ground, in_a_box<D>(mesh, pressure), {.step = 1, .statics = true, .damping = {}});
    stepper.start();
    for (int step = 0; step < 3; ++step) stepper.advance();
    for (std::size_t i = 0; i < stepper.body().pores().size(); ++i)
      EXPECT_NEAR(stepper.body().pores().mean(i, stepper.state().velocity), share * pressure, 1e-9 * pressure) << test::name_of(shape);
    const auto top = test::node_at(mesh, {0.5, D == 2 ? 2.0 : 0.5, 2});
    EXPECT_NEAR(stepper.state().displacement[number<D>(top, D - 1)], -(1 - share) * pressure / modulus * 2, 1e-10 * pressure / modulus);
    EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9 * stepper.work().loads);
  });
}

/// Excess pressures in a layer of 2 m that drains to its top, at a time factor of 0.2, less Terzaghi's, over the load: the largest.
template <int D>
Real error_of_consolidation(ElementShape shape, int cells, int steps) {
  const ElementMesh mesh =
      test::box(shape, D == 2 ? test::BoxRules{{0.5, 2, 0}, {1, cells, 1}, 0} : test::BoxRules{{0.5, 0.5, 2}, {1, 1, cells}, 0});
  const Real conductivity = 1e-5, load = 1e5, height = 2;
  const SolidMaterial ground = saturated(2e7, 0.2, conductivity, D, 1e12);
  const Real modulus = ground.elastic.lame + 2 * ground.elastic.shear_modulus;
  const Real consolidation = conductivity / unit_weight * modulus, end = 0.2 * height * height / consolidation;
  auto supports = in_a_box<D>(mesh, load);
  supports.drained = nodes_of(mesh, "top");
  auto stepper = stepper_of<D>(mesh, ground, supports, {.step = end / steps, .statics = true, .damping = {}});
  stepper.start();
  for (int step = 0; step < steps; ++step) stepper.advance();
  EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9 * stepper.work().loads);
  EXPECT_GT(stepper.work().seepage, 0);
  Real largest = 0;
  for (const Real depth : {0.5, 1.0, 1.5, 2.0}) {
    // The mean over the corners of the column: simplices lean to one side.
    Real sum = 0;
    for (const Real x : {0.0, 0.5})
      for (const Real y : {0.0, 0.5}) {
        const Index node = test::node_at(mesh, {x, D == 2 ? 2 - depth : y, 2 - depth});
        for (const auto& [pressure, share] : stepper.body().pores().shares_at(node))
          sum += 0.25 * share * pore_pressure<D>(pressure, stepper.state().velocity) / load;
      }
    largest = std::max(largest, std::abs(sum - terzaghi(depth, height, 0.2)));
  }
  return largest;
}

TEST(pores, drain_as_terzaghis_layer) {
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    EXPECT_LT((error_of_consolidation<D>(shape, 32, 400)), 1e-3) << test::name_of(shape);
  });
}

TEST(pores, drain_to_first_order_of_the_static_step) {
  const Real coarse = error_of_consolidation<2>(ElementShape::quadrilateral8, 64, 100),
             fine = error_of_consolidation<2>(ElementShape::quadrilateral8, 64, 200);
  EXPECT_NEAR(coarse / fine, 2, 0.1);
}

/// A layer of 4 m whose surface is pushed down and aside from the beginning on.
template <int D>
FemStepper<D> pushed_layer(ElementShape shape, Real conductivity, const Vector3& push) {
  const ElementMesh mesh =
      test::box(shape, D == 2 ? test::BoxRules{{2, 4, 0}, {2, 6, 1}, 0.2} : test::BoxRules{{2, 2, 4}, {2, 2, 4}, 0.2});
  SolidMaterial ground = saturated(5e7, 0.3, conductivity, D);
  ground.saturation->pore_water.specific_weight = unit_weight;
  ground.saturation->pore_water.level = 4;
  Supports<D> supports;
  supports.gravity[D - 1] = -9.81;
  for (const std::string side : {"left", "right"}) test::hold<D>(mesh, side, D - 1, supports);
  for (int axis = 0; axis < D; ++axis) test::hold<D>(mesh, "bottom", axis, supports);
  supports.loads.push_back({"push", test::traction(mesh, "top", push), 0});
  return stepper_of<D>(mesh, ground, supports, {.step = 0.01, .damping = {}});
}

TEST(pores, stay_at_rest_under_gravity) {
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    auto stepper = pushed_layer<D>(shape, 1e-4, Vector3::Zero());
    stepper.relax();
    auto still = stepper_of<D>(stepper.body().mesh(), stepper.body().description().materials[0], stepper.supports(),
                               {.step = 0.01, .statics = true, .damping = {}});
    still.relax();
    still.start();
    for (int step = 0; step < 5; ++step) still.advance();
    Real most = 0;
    for (std::size_t i = 0; i < still.body().pores().size(); ++i)
      most = std::max(most, std::abs(still.body().pores().mean(i, still.state().velocity)));
    EXPECT_LT(most, 1e-6 * unit_weight * 4) << test::name_of(shape);
  });
}

TEST(pores, keep_the_energy_balance_of_a_layer_under_a_sudden_load) {
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    for (const Real conductivity : {0.0, 1e-4, 1e-1}) {
      auto stepper = pushed_layer<D>(shape, conductivity, D == 2 ? Vector3(1e4, -2e4, 0) : Vector3(1e4, 5e3, -2e4));
      stepper.relax();
      stepper.start();
      Real largest = 0;
      for (int step = 0; step < 60; ++step) {
        stepper.advance();
        largest = std::max(largest, stepper.kinetic_energy());
      }
      EXPECT_LT(std::abs(stepper.energy_residual()), 1e-8 * largest) << test::name_of(shape) << conductivity;
      EXPECT_GE(stepper.work().seepage, 0);
      EXPECT_EQ(stepper.work().seepage > 0, conductivity > 0);
    }
  });
}

/// Loose sand in simple shear to and fro at a constant volume: undrained where its water is stiff.
TEST(pores, take_up_what_cycles_of_shear_take_from_the_volume) {
  const ElementMesh mesh = test::box(ElementShape::quadrilateral4, {{1, 1, 0}, {2, 2, 1}, 0});
  SolidMaterial sand = saturated(2e7, 0.3, 0, 2, 1e11);
  sand.strength = laws::MohrCoulomb::make(1e4, 0.5, 0, std::nullopt);
  sand.contraction = laws::CyclicContraction(0.5, 0.8, 0);
  Supports<2> supports;
  laws::GroundMotion motion;
  motion.shape = laws::GroundMotion::Shape::sine;
  motion.quantity = laws::MotionQuantity::displacement;
  motion.amplitude = 3e-4;  // the strain, below yielding
  motion.sine_wave.frequency = 1;
  supports.motions.push_back(motion);
  for (const std::string side : {"left", "right", "top", "bottom"}) test::hold<2>(mesh, side, 1, supports);
  test::hold<2>(mesh, "bottom", 0, supports);
  test::hold<2>(mesh, "top", 0, supports, 0);
  auto stepper = stepper_of<2>(mesh, sand, supports, {.step = 0.01, .statics = true, .damping = {}});
  stepper.start();
  Real lost = sand.contraction->half_cycle(1.5e-4, 0);
  for (int half = 0; half < 9; ++half) lost += sand.contraction->half_cycle(3e-4, lost);
  for (int step = 0; step < 500; ++step) stepper.advance();
  const auto& pores = stepper.body().pores();
  // Water does not let the skeleton follow: it loses the pressure that the volume would have taken, and along x, where nothing but
  // the sand bears, the water takes it over.
  const Real taken = (sand.elastic.lame + 2 * sand.elastic.shear_modulus / 3) * lost;
  for (const auto& mean : stepper.body().means(stepper.state().displacement, stepper.state().memory))
    EXPECT_NEAR(mean.stress.head<3>().mean(), taken, 1e-3 * taken);
  for (std::size_t i = 0; i < pores.size(); ++i) EXPECT_NEAR(pores.mean(i, stepper.state().velocity), taken, 1e-3 * taken);
  EXPECT_GT(lost, 1e-4);
}

}  // namespace
}  // namespace sazare::methods::fem
