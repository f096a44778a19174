#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/wet_faces.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

constexpr Real density = 1000, gravity = 9.81, unit_weight = density * gravity;

laws::WaterPressure water_at(Real level, int dimension) { return {unit_weight, dimension - 1, level}; }

template <int D>
void press(const ElementMesh& mesh, const std::string& group, const laws::WaterPressure& water, StillWater<D>& made) {
  made.pressure.force.resize(mesh.nodes.size() * D, 0);
  for (const auto& face : mesh.find_group(group)->elements) {
    const Eigen::VectorXd force = pressure_force<D>(mesh, face, water);
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      made.pressure.force[number<D>(face.nodes[static_cast<std::size_t>(i / D)], static_cast<int>(i % D))] += force[i];
      made.force[static_cast<int>(i % D)] += force[i];
    }
  }
}

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

/// Water of a depth of 2 m on the left side of a box: its mass, and the moment of the masses about the level.
template <int D>
std::pair<Real, Real> mass_on_the_left(ElementShape shape, int cells, MassMatrix kind) {
  const auto mesh =
      test::box(shape, D == 2 ? test::BoxRules{{1, 2, 0}, {1, cells, 1}, 0} : test::BoxRules{{1, 0.7, 2}, {1, 2, cells}, 0});
  Real mass = 0, moment = 0;
  for (const auto& face : mesh.find_group("left")->elements) {
    const Eigen::MatrixXd matrix = added_mass<D>(mesh, face, water_at(2, D), density, 2, kind);
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
    const Real width = D == 2 ? 1 : 0.7, exact = 7.0 / 12 * density * 4 * width, arm = 7.0 / 20 * density * 8 * width;
    for (const MassMatrix kind : {MassMatrix::consistent, MassMatrix::lumped}) {
      const auto [mass, moment] = mass_on_the_left<D>(shape, 8, kind);
      EXPECT_NEAR(mass, exact, 4e-4 * exact) << test::name_of(shape);
      EXPECT_NEAR(moment, arm, (kind == MassMatrix::consistent ? 4e-4 : 1e-2) * arm) << test::name_of(shape);
    }
  });
}

TEST(added_mass, converges_as_the_root_at_the_surface_allows) {
  const Real exact = 7.0 / 12 * density * 4;
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
      const Eigen::MatrixXd mass = added_mass<2>(mesh, face, water_at(2.5, 2), density, 1.5, kind);
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
      const Real mass = wall + (with_water ? 7.0 / 12 * density * 1.5 * 1.5 : 0);
      const Real omega = 2 / step * std::atan(0.5 * step * std::sqrt(stiffness / mass));  // as Newmark's step has it
      const int steps = static_cast<int>(4.25 * 2 * std::numbers::pi / (omega * step));   // where the motion is fastest
      const Real exact = wall / stiffness * (1 - std::cos(omega * step * steps));
      EXPECT_NEAR(swing(with_water, kind, steps, step), exact, (with_water ? 3e-3 : 1e-4) * wall / stiffness);
    }
}

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
  return FemStepper<2>(
      std::make_unique<Body<2>>(test::of_one_material(mesh, SolidMaterial::elastic_of(1e9, 0.2, weight_over_buoyancy * density))),
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

TEST(energy_balance, counts_the_work_of_water_that_is_there_comes_and_has_settled) {
  for (const bool statics : {true, false})
    for (const Real ramp : {0.0, 0.3})
      for (const bool settles : {true, false}) {
        const auto mesh = test::box(ElementShape::quadrilateral8, {{1, 4, 1}, {2, 6, 1}, 0});
        Supports<2> supports;
        for (int axis = 0; axis < 2; ++axis) test::hold<2>(mesh, "bottom", axis, supports);
        supports.gravity.y() = -gravity;
        StillWater<2> water;
        press<2>(mesh, "left", water_at(3.1, 2), water);
        water.pressure.ramp = ramp;
        for (const auto& face : mesh.find_group("left")->elements)
          water.moving.push_back({{face.node_list().begin(), face.node_list().end()},
                                  added_mass<2>(mesh, face, water_at(3.1, 2), density, 3.1, MassMatrix::consistent)});
        supports.waters = {water};
        supports.loads = {{"push", test::traction(mesh, "right", {-1e3, 0, 0}), 0.2}};
        FemRules rules;
        rules.step = 0.1;
        rules.statics = statics;
        rules.tolerance = 1e-12;
        FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, SolidMaterial::elastic_of(2e7, 0.2, 2000))),
                              supports, rules);
        if (settles) stepper.relax();
        stepper.start();
        const Real at_start = stepper.elastic_energy();
        EXPECT_NEAR(at_start, 0, 1e-9);
        Real most = 0;
        for (int step = 0; step < 6; ++step) {
          stepper.advance();
          most = std::max(most, std::abs(stepper.elastic_energy()) + stepper.kinetic_energy());
          EXPECT_NEAR(stepper.energy_residual(), 0, 1e-8 * most) << statics << ramp << settles << step;
        }
        EXPECT_NE(stepper.work().water, 0);
      }
}

/// The force that a wall feels is that of the pressure, and the inertia of the water that moves with it.
TEST(energy_balance, water_gives_a_moved_wall_the_force_of_its_inertia) {
  const auto mesh = test::box(ElementShape::quadrilateral4, {{1, 2, 1}, {1, 4, 1}, 0});
  Supports<2> supports;
  laws::GroundMotion motion;
  motion.quantity = laws::MotionQuantity::acceleration;
  motion.ricker_wave = {2, 0.5};
  supports.motions = {motion};
  StillWater<2> water;
  press<2>(mesh, "left", water_at(2, 2), water);
  for (const auto& face : mesh.find_group("left")->elements)
    water.moving.push_back({{face.node_list().begin(), face.node_list().end()},
                            added_mass<2>(mesh, face, water_at(2, 2), density, 2, MassMatrix::lumped)});
  supports.waters = {water};
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    supports.held.push_back({static_cast<Index>(node), 0, 0, 0});
    supports.held.push_back({static_cast<Index>(node), 1, Support::no_motion, 0});
  }
  supports.held.pop_back();  // one freedom is left to find
  FemRules rules;
  rules.step = 1e-2;
  FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, SolidMaterial::elastic_of(1e9, 0, 2000))), supports,
                        rules);
  stepper.start();
  while (stepper.time() < 0.5) stepper.advance();
  const Real acceleration = motion.at(stepper.time()).acceleration, moving = supports.waters[0].moving_mass();
  EXPECT_GT(std::abs(acceleration), 0.5);
  EXPECT_NEAR(moving, 7.0 / 12 * density * 4, 2e-3 * density * 4);
  const Real still = unit_weight * 2;
  EXPECT_NEAR(stepper.water_force(0).x(), still - moving * acceleration, 1e-9 * still);
  Real reaction = 0;
  for (const Support& support : stepper.supports().held)
    if (support.axis == 0) reaction += stepper.reactions()[number<2>(support.node, 0)];
  EXPECT_NEAR(reaction, (2000 * 2 + moving) * acceleration - still, 1e-9 * still);
}

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
          const Real effective = gravity * (1700 * dry + (2050 - density) * wet);
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
