#include <gtest/gtest.h>

#include <set>

#include "sazare/geometry/interface_split.hpp"
#include "sazare/methods/fem/boundary_faces.hpp"
#include "sazare/methods/fem/soil_column.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

constexpr Real height = 10;

SolidMaterial ground(Real s_wave_velocity, Real density, Real damping_ratio) {
  SolidMaterial material;
  material.density = density;
  material.damping_ratio = damping_ratio;
  material.elastic = {density * s_wave_velocity * s_wave_velocity, 1.5 * density * s_wave_velocity * s_wave_velocity};
  return material;
}

SolidMaterial soil(Real s_wave_velocity) {
  SolidMaterial material = ground(s_wave_velocity, 1800, 0.01);
  const Real modulus = material.elastic.shear_modulus;
  material.backbone = laws::hyperbolic_curve(modulus, 1e-3, 1e-3 * modulus, 20);
  return material;
}

laws::GroundMotion wavelet(Real amplitude, Real delay) {
  laws::GroundMotion motion;
  motion.quantity = laws::MotionQuantity::velocity;
  motion.ricker_wave = {8, delay};
  motion.amplitude = amplitude;
  return motion;
}

struct Scene {
  ElementShape shape = ElementShape::quadrilateral4;
  Integration integration = Integration::full;
  std::vector<SolidMaterial> layers{ground(200, 2000, 0.02), ground(120, 1700, 0.05)};  ///< from below, of equal height
  bool viscous_base = true;
  bool shakes = true;
  Real gravity = 0;
  Real alpha = 0;
  Real amplitude = 1;
};

template <int D>
BodyDescription layered(const Scene& scene) {
  BodyDescription body;
  body.mesh = test::box(scene.shape, {{12, D == 2 ? height : 6, height}, {4, D == 2 ? 8 : 2, 8}, 0});
  body.materials = scene.layers;
  body.integration = scene.integration;
  for (const auto& element : body.mesh.elements) {
    Real elevation = 0;
    for (const Index node : element.node_list()) elevation += body.mesh.nodes[at(node)][D - 1];
    elevation /= static_cast<Real>(element.node_list().size());
    body.material.push_back(static_cast<Index>(elevation / height * static_cast<Real>(scene.layers.size())));
  }
  return body;
}

template <int D>
void add_base(const Scene& scene, const BodyDescription& body, Supports<D>& supports) {
  if (scene.shakes)
    for (int axis = 0; axis < D; ++axis)
      supports.motions.push_back(wavelet(scene.amplitude * (1 - 0.3 * axis), 0.15 + 0.03 * axis));
  const auto motion = [&](int axis) { return scene.shakes ? static_cast<Index>(axis) : Support::no_motion; };
  if (!scene.viscous_base) {
    for (int axis = 0; axis < D; ++axis) test::hold<D>(body.mesh, "bottom", axis, supports, motion(axis));
    supports.find_base();
    return;
  }
  ViscousBoundary<D> base;
  const auto& group = *body.mesh.find_group("bottom");
  for (int axis = 0; axis < D; ++axis) base.motion[static_cast<std::size_t>(axis)] = motion(axis);
  std::set<Index> nodes;
  for (const auto& face : group.elements) {
    base.faces.push_back(viscous_face<D>(body, 0, face));
    nodes.insert(face.node_list().begin(), face.node_list().end());
  }
  base.nodes.assign(nodes.begin(), nodes.end());
  supports.viscous.push_back(base);
}

template <int D>
void add_sides(const BodyDescription& body, Supports<D>& supports) {
  std::vector<std::string> names{"left", "right"};
  if constexpr (D == 3) names.insert(names.end(), {"front", "back"});
  for (const std::string& name : names)
    for (auto& side : free_field_sides<D>(body, *body.mesh.find_group(name), 1)) {
      stand_on_base(side, supports);
      std::erase_if(side.nodes, [&](Index node) {
        return std::ranges::any_of(supports.viscous, [&](const auto& base) { return std::ranges::count(base.nodes, node) > 0; });
      });
      supports.sides.push_back(std::move(side));
    }
}

FemRules rules_of(const Scene& scene) {
  FemRules rules;
  rules.step = 2e-3;
  rules.alpha = scene.alpha;
  rules.tolerance = 1e-11;
  rules.damping = laws::RayleighDamping::make(2, 15);
  return rules;
}

template <int D>
FemStepper<D> level_ground(const Scene& scene) {
  BodyDescription body = layered<D>(scene);
  Supports<D> supports;
  supports.gravity[D - 1] = -scene.gravity;
  add_base(scene, body, supports);
  add_sides(body, supports);
  return FemStepper<D>(std::make_unique<Body<D>>(std::move(body)), std::move(supports), rules_of(scene));
}

/// The largest difference between the velocities of the body and of the column at the same elevations, over the largest.
template <int D>
struct Comparison {
  Real error = 0, largest = 0;

  void look_at(const FemStepper<D>& stepper) {
    const auto& column = stepper.supports().sides[0].column->body.mesh.nodes;
    const auto& nodes = stepper.body().mesh().nodes;
    for (std::size_t node = 0; node < nodes.size(); ++node)
      for (std::size_t level = 0; level < column.size(); ++level) {
        if (std::abs(nodes[node][D - 1] - column[level][D - 1]) > 1e-6) continue;
        for (std::size_t axis = 0; axis < D; ++axis) {
          const Real own = stepper.state().velocity[node * D + axis];
          error = std::max(error, std::abs(own - stepper.state().columns[0].velocity[level * D + axis]));
          largest = std::max(largest, std::abs(own));
        }
      }
  }
};

template <int D>
void expect_moves_as_its_column(const Scene& scene, Real tolerance, int steps = 250) {
  auto stepper = level_ground<D>(scene);
  if (scene.gravity > 0) stepper.relax();
  stepper.start();
  Comparison<D> seen;
  for (int step = 0; step < steps; ++step) {
    stepper.advance();
    seen.look_at(stepper);
  }
  EXPECT_GT(seen.largest, 0.5 * scene.amplitude);
  EXPECT_LT(seen.error, tolerance * seen.largest) << test::name_of(scene.shape);
  const Real work = std::abs(stepper.work().waves) + std::abs(stepper.work().sides) + std::abs(stepper.work().boundary);
  if (scene.alpha == 0 && scene.viscous_base) {
    EXPECT_NEAR(stepper.energy_residual(), 0, 1e-8 * work);
  }
}

TEST(free_field, moves_layers_as_their_column) {
  for (const ElementShape shape : {ElementShape::quadrilateral4, ElementShape::quadrilateral8, ElementShape::quadrilateral9})
    for (const bool viscous : {true, false}) expect_moves_as_its_column<2>({.shape = shape, .viscous_base = viscous}, 1e-9);
  expect_moves_as_its_column<2>({.shape = ElementShape::quadrilateral8, .integration = Integration::reduced, .alpha = -0.1},
                                1e-9);
}

TEST(free_field, moves_layers_in_space_as_their_column) {
  for (const bool viscous : {true, false})
    expect_moves_as_its_column<3>({.shape = ElementShape::hexahedron8, .viscous_base = viscous}, 1e-9, 150);
  expect_moves_as_its_column<3>({.shape = ElementShape::hexahedron20}, 1e-9, 100);
}

TEST(free_field, moves_soil_that_degrades_as_its_column) {
  Scene scene;
  scene.shape = ElementShape::quadrilateral8;
  scene.layers = {ground(200, 2000, 0.02), soil(120)};
  scene.amplitude = 0.3;
  expect_moves_as_its_column<2>(scene, 1e-6);
  scene.gravity = 9.81;
  expect_moves_as_its_column<2>(scene, 1e-6);
}

/// A valley side: the right half of the surface stands half as high again.
BodyDescription slope(const Scene& scene) {
  BodyDescription body = layered<2>(scene);
  for (Vector3& node : body.mesh.nodes) node.y() *= 1 + 0.5 * std::clamp((node.x() - 4.5) / 3, 0.0, 1.0);
  return body;
}

FemStepper<2> sloping_ground(const Scene& scene) {
  BodyDescription body = slope(scene);
  Supports<2> supports;
  supports.gravity = {0, -scene.gravity};
  add_base(scene, body, supports);
  add_sides(body, supports);
  return FemStepper<2>(std::make_unique<Body<2>>(std::move(body)), std::move(supports), rules_of(scene));
}

TEST(free_field, leaves_a_body_at_rest_alone) {
  for (const bool degrades : {false, true}) {
    Scene scene{.shakes = false, .gravity = 9.81};
    if (degrades) scene.layers = {ground(200, 2000, 0.02), soil(200)};
    auto stepper = sloping_ground(scene);
    stepper.relax();
    stepper.start();
    for (int step = 0; step < 50; ++step) {
      stepper.advance();
      for (const Real acceleration : stepper.state().acceleration) EXPECT_NEAR(acceleration, 0, 1e-7 * scene.gravity);
    }
  }
}

/// The side pushes inwards as ground does that cannot move sideways: K0 of the weight above it. The corner's share is the base's.
TEST(free_field, carries_the_pressure_of_ground_at_rest) {
  const Scene scene{.shape = ElementShape::quadrilateral8,
                    .layers = {ground(200, 2000, 0)},
                    .viscous_base = false,
                    .shakes = false,
                    .gravity = 9.81};
  auto stepper = level_ground<2>(scene);
  stepper.relax();
  stepper.start();
  stepper.advance();
  const laws::Elasticity elastic = scene.layers[0].elastic;
  const Real by_depth = elastic.lame / (elastic.lame + 2 * elastic.shear_modulus) * 2000 * 9.81;
  const Real thrust = by_depth * height * (height / 2 - height / 8 / 6);
  EXPECT_NEAR(stepper.side_force(0).x(), thrust, 1e-9 * thrust);
  EXPECT_NEAR(stepper.side_force(1).x(), -thrust, 1e-9 * thrust);
}

TEST(free_field, doubles_a_wave_at_the_surface_of_a_half_space) {
  const Real speed = 200;
  Scene scene{.shape = ElementShape::quadrilateral8, .layers = {ground(speed, 2000, 0)}};
  auto stepper = level_ground<2>(scene);
  stepper.start();
  Real worst = 0;
  for (int step = 0; step < 250; ++step) {
    stepper.advance();
    const Real p_speed = scene.layers[0].p_wave_velocity();
    const Real exact_x = 2 * stepper.supports().motions[0].at(stepper.time() - height / speed).velocity;
    const Real exact_y = 2 * stepper.supports().motions[1].at(stepper.time() - height / p_speed).velocity;
    for (const Real x : {0.0, 6.0, 12.0}) {
      const auto node = at(test::node_at(stepper.body().mesh(), {x, height, 0}));
      worst = std::max({worst, std::abs(stepper.state().velocity[2 * node] - exact_x),
                        std::abs(stepper.state().velocity[2 * node + 1] - exact_y)});
    }
  }
  EXPECT_LT(worst, 0.02 * 2);
}

/// Without a wave from below the columns stand still.
TEST(free_field, absorbs_what_comes_from_within_as_a_viscous_boundary) {
  Scene scene{.shakes = false};
  const auto run = [&](bool free_field) {
    BodyDescription body = layered<2>(scene);
    Supports<2> supports;
    add_base(scene, body, supports);
    if (free_field) {
      add_sides(body, supports);
    } else {
      for (const std::string name : {"left", "right"}) {
        ViscousBoundary<2> side;
        side.motion = {Support::no_motion, Support::no_motion};
        const auto& group = *body.mesh.find_group(name);
        const auto beside = geometry::elements_beside(body.mesh, group);
        for (std::size_t i = 0; i < group.elements.size(); ++i)
          side.faces.push_back(viscous_face<2>(body, beside[i], group.elements[i]));
        supports.viscous.push_back(side);
      }
    }
    supports.loads = {{"blow", test::traction(body.mesh, "top", {1e3, -2e3, 0}), 0.05}};
    FemStepper<2> stepper(std::make_unique<Body<2>>(std::move(body)), std::move(supports), rules_of(scene));
    stepper.start();
    for (int step = 0; step < 100; ++step) stepper.advance();
    EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9 * stepper.work().loads);
    EXPECT_GT(stepper.work().radiation, 0.1 * stepper.work().loads);
    return stepper.state().velocity;
  };
  const NodalColumn with = run(true), without = run(false);
  for (std::size_t i = 0; i < with.size(); ++i) EXPECT_NEAR(with[i], without[i], 1e-12);
}

TEST(free_field, goes_through_a_window_again_with_the_same_bits) {
  Scene scene;
  scene.layers = {ground(200, 2000, 0.02), soil(120)};
  scene.gravity = 9.81;
  auto stepper = sloping_ground(scene);
  stepper.relax();
  stepper.start();
  for (int step = 0; step < 70; ++step) stepper.advance();
  const FemState<2> saved = stepper.state();
  for (int step = 0; step < 10; ++step) stepper.advance();
  const NodalColumn first = stepper.state().velocity;
  stepper.restore(saved);
  for (int step = 0; step < 10; ++step) stepper.advance();
  EXPECT_EQ(stepper.state().velocity, first);
}

void expect_unfit(const BodyDescription& body, const std::string& group, const std::string& words) {
  try {
    free_field_sides<2>(body, *body.mesh.find_group(group), 0);
    ADD_FAILURE() << "not refused: " << words;
  } catch (const UnfitSide& unfit) {
    EXPECT_NE(std::string(unfit.what()).find(words), std::string::npos) << unfit.what();
  }
}

TEST(free_field, refuses_sides_beside_which_no_column_can_stand) {
  BodyDescription body = layered<2>({});
  expect_unfit(body, "top", "is not vertical");
  BodyDescription leaning = body;
  for (Vector3& node : leaning.mesh.nodes) node.x() += 0.01 * node.y();
  expect_unfit(leaning, "left", "is not vertical");
  auto& faces = std::ranges::find(body.mesh.groups, "left", &geometry::ElementGroup::name)->elements;
  faces.erase(faces.begin() + 3);
  expect_unfit(body, "left", "has a gap between the elevations 3.75 and 5 m");
  BodyDescription solid = layered<3>({.shape = ElementShape::hexahedron8});
  for (std::size_t e = 0; e < solid.mesh.elements.size(); ++e)
    if (solid.mesh.nodes[at(solid.mesh.elements[e].nodes[0])].y() > 1) solid.material[e] = 0;
  EXPECT_THROW(free_field_sides<3>(solid, *solid.mesh.find_group("left"), 0), UnfitSide);
  BodyDescription uneven = layered<3>({.shape = ElementShape::hexahedron8});
  for (Vector3& node : uneven.mesh.nodes) node.z() *= 1 + 0.1 * node.y();
  EXPECT_THROW(free_field_sides<3>(uneven, *uneven.mesh.find_group("left"), 0), UnfitSide);
  Supports<2> nothing;
  auto side = free_field_sides<2>(layered<2>({}), *body.mesh.find_group("right"), 0);
  EXPECT_THROW(stand_on_base(side[0], nothing), UnfitSide);
}

}  // namespace
}  // namespace sazare::methods::fem
