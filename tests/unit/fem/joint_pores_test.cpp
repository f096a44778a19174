#include <gtest/gtest.h>

#include <cmath>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

constexpr Real unit_weight = 9810, water_bulk = 1e8, porosity = 0.4, friction = 0.1, normal_stiffness = 2e8, height = 1;

/// Saturated to a water table far above, and without weight.
SolidMaterial saturated(Real conductivity, int dimension) {
  auto material = SolidMaterial::elastic_of(3e7, 0.25, 1600);
  material.saturation = Saturation{2000, {0, dimension - 1, 100}, PoreFlow{porosity / water_bulk, conductivity / unit_weight}};
  return material;
}

/// A block of 1 m on saturated ground of 1 m with a joint between them, which presses before the water counts and is loaded
/// then; the ground does not spread.
template <int D>
struct OnGround {
  BodyDescription description;
  Supports<D> supports;

  OnGround(ElementShape shape, Real conductivity, bool above_too = false) {
    auto mesh = test::box(shape, D == 2 ? test::BoxRules{{1, 2, 0}, {2, 4, 1}, 0} : test::BoxRules{{1, 1, 2}, {2, 2, 4}, 0});
    mesh.region_names = {"ground", "block"};
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      Real sum = 0;
      for (const Index node : mesh.elements[e].node_list()) sum += mesh.nodes[at(node)][D - 1];
      mesh.region[e] = sum > height * static_cast<Real>(mesh.elements[e].node_list().size()) ? 1 : 0;
    }
    const auto faces = geometry::split(mesh, {geometry::faces_between(mesh, 0, 1)});
    description = test::of_one_material(mesh, saturated(conductivity, D));
    description.materials.push_back(SolidMaterial::elastic_of(1e10, 0, 2000));
    if (above_too) description.materials.push_back(saturated(conductivity, D));
    description.material.assign(mesh.region.begin(), mesh.region.end());
    if (above_too)
      for (Index& material : description.material) material = material == 1 ? 2 : material;
    description.joints = {{"sole", {normal_stiffness, 1e10, 0, friction}, faces.front()}};
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
      for (int axis = 0; axis < D - 1; ++axis)
        if (mesh.nodes[node][D - 1] < height || is_of_ground(node))
          supports.held.push_back({static_cast<Index>(node), axis, Support::no_motion, 0});
    test::hold<D>(mesh, "bottom", D - 1, supports);
  }

  bool is_of_ground(std::size_t node) const {
    const auto& mesh = description.mesh;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (const Index one : mesh.elements[e].node_list())
        if (at(one) == node && mesh.region[e] == 0) return true;
    return false;
  }

  void hold_block_aside() {
    for (std::size_t node = 0; node < description.mesh.nodes.size(); ++node)
      for (int axis = 0; axis < D - 1; ++axis)
        if (!is_of_ground(node)) supports.held.push_back({static_cast<Index>(node), axis, Support::no_motion, 0});
  }

  void load(const std::string& name, const Vector3& traction, Real ramp) {
    supports.loads.push_back({name, test::traction(description.mesh, "top", traction), ramp});
  }

  FemStepper<D> stepper(const FemRules& rules) { return {std::make_unique<Body<D>>(description), supports, rules}; }
};

template <int D>
Vector3 down(Real pressure) {
  Vector3 traction = Vector3::Zero();
  traction[D - 1] = -pressure;
  return traction;
}

template <int D>
Real pressed(const FemStepper<D>& stepper) {
  return std::abs(stepper.body().joints().summary(0, stepper.state().displacement, stepper.state().memory.joints).force[D - 1]);
}

TEST(pores_beside_a_joint, share_a_load_with_it_as_water_and_ground_between_two_plates) {
  // No water leaves: what ground and joint are compressed by, s h/M + s/k with the effective stress s, the water takes, (load -
  // s) S h.
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    OnGround<D> ground(shape, 1e-2);
    ground.hold_block_aside();
    const Real load = 5e4;
    ground.load("load", down<D>(load), 0);
    auto stepper = ground.stepper({.step = 1e3, .statics = true, .tolerance = 1e-11, .damping = {}});
    stepper.start();
    for (int step = 0; step < 40; ++step) stepper.advance();
    const auto& elastic = ground.description.materials[0].elastic;
    const Real storage = porosity / water_bulk, soft = height / (elastic.lame + 2 * elastic.shear_modulus) + 1 / normal_stiffness;
    const Real effective = load * storage * height / (soft + storage * height);
    EXPECT_NEAR(pressed(stepper), effective, 1e-7 * load) << test::name_of(shape);
    for (std::size_t i = 0; i < stepper.body().pores().size(); ++i)
      EXPECT_NEAR(stepper.body().pores().mean(i, stepper.state().velocity), load - effective, 1e-7 * load);
    EXPECT_NEAR(stepper.energy_residual(), 0, 1e-7 * stepper.work().loads) << test::name_of(shape);
  });
}

TEST(pores_beside_a_joint, of_both_sides_push_with_their_mean) {
  // The same ground above and below: the joint gives each half of its water.
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    OnGround<D> ground(shape, 1e-2, true);
    ground.hold_block_aside();
    const Real load = 5e4;
    ground.load("load", down<D>(load), 0);
    auto stepper = ground.stepper({.step = 1e3, .statics = true, .tolerance = 1e-11, .damping = {}});
    stepper.start();
    for (int step = 0; step < 40; ++step) stepper.advance();
    const auto& elastic = ground.description.materials[0].elastic;
    const Real storage = porosity / water_bulk,
               soft = 2 * height / (elastic.lame + 2 * elastic.shear_modulus) + 1 / normal_stiffness;
    const Real effective = load * storage * 2 * height / (soft + storage * 2 * height);
    EXPECT_NEAR(pressed(stepper), effective, 1e-7 * load) << test::name_of(shape);
  });
}

TEST(pores_beside_a_joint, leave_a_block_the_friction_of_the_effective_stress) {
  // The block presses with s0; a load that the water takes nearly all gives no friction.
  for (const bool drains : {false, true}) {
    const auto slips = [&](Real push) {
      OnGround<2> ground(ElementShape::quadrilateral8, drains ? 1e-2 : 0);
      ground.description.materials[0].saturation->flow->compressibility = porosity / 1e12;
      ground.supports.gravity.y() = -9.81;
      ground.load("weight", down<2>(8e4), 1);
      ground.load("push", {push, 0, 0}, 10);
      if (drains)
        for (std::size_t p = 0; p < Body<2>(ground.description).pores().pressure_nodes(); ++p)
          ground.supports.drained.push_back(Body<2>(ground.description).pores().node_of(p));
      auto stepper = ground.stepper({.step = 0.5, .statics = true, .damping = {}});
      stepper.relax();
      stepper.start();
      try {
        for (int step = 0; step < 20; ++step) stepper.advance();
      } catch (const std::exception&) {
        return true;
      }
      EXPECT_LT(std::abs(stepper.energy_residual()), 1e-6 * stepper.work().loads) << drains;
      return false;
    };
    const Real weight = 9.81 * 2000 * height, limit = friction * (weight + (drains ? 8e4 : 0));
    EXPECT_FALSE(slips(0.99 * limit)) << drains;
    EXPECT_TRUE(slips(1.01 * limit)) << drains;
  }
}

TEST(pores_beside_a_joint, keep_the_energy_balance_while_a_block_is_shaken) {
  for (const Real conductivity : {0.0, 1e-3}) {
    OnGround<2> ground(ElementShape::quadrilateral8, conductivity);
    ground.supports.gravity = {0.5, -9.81};
    ground.load("load", {1e4, -6e4, 0}, 0);
    auto stepper = ground.stepper({.step = 1e-3, .tolerance = 1e-9, .damping = {}});
    stepper.relax();
    stepper.start();
    Real most = 0;
    for (int step = 0; step < 100; ++step) {
      stepper.advance();
      most = std::max(most, stepper.kinetic_energy());
    }
    EXPECT_GT(most, 0);
    EXPECT_LT(std::abs(stepper.energy_residual()), 1e-3 * most) << conductivity;
  }
}

}  // namespace
}  // namespace sazare::methods::fem
