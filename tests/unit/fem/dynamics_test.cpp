#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>

#include "sazare/core/error.hpp"
#include "sazare/methods/fem/boundary_faces.hpp"
#include "sazare/parallel/threads.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

using methods::fem::FemRules, methods::fem::FemStepper;

constexpr Real s_wave_velocity = 100, density = 2000, height = 10;

SolidMaterial soil() {
  SolidMaterial material;
  material.density = density;
  material.elastic = {density * s_wave_velocity * s_wave_velocity, 2 * density * s_wave_velocity * s_wave_velocity};
  return material;
}

laws::GroundMotion wavelet() {
  laws::GroundMotion motion;
  motion.quantity = laws::MotionQuantity::velocity;
  motion.ricker_wave = {10, 0.1};
  return motion;
}

ViscousBoundary<2> viscous_base(const ElementMesh& mesh, Index motion) {
  ViscousBoundary<2> base;
  base.motion = {motion, Support::no_motion};
  const SolidMaterial material = soil();
  for (const auto& face : mesh.find_group("bottom")->elements)
    base.faces.push_back(
        {{face.node_list().begin(), face.node_list().end()},
         face_impedance<2>(mesh, face, density * material.p_wave_velocity(), density * material.s_wave_velocity())});
  return base;
}

/// A column in shear that a wavelet enters from below.
FemStepper<2> column(ElementShape shape, int cells, Real step, Real alpha = 0, MassMatrix mass = MassMatrix::consistent) {
  const auto mesh = test::box(shape, {{1, height, 1}, {1, cells, 1}, 0});
  auto description = test::of_one_material(mesh, soil());
  description.mass = mass;
  Supports<2> supports;
  supports.motions = {wavelet()};
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    supports.held.push_back({static_cast<Index>(node), 1, Support::no_motion, 0});
  supports.viscous = {viscous_base(mesh, 0)};
  FemRules rules;
  rules.step = step;
  rules.alpha = alpha;
  return FemStepper<2>(std::make_unique<Body<2>>(std::move(description)), std::move(supports), rules);
}

/// Largest error of the surface's velocity, which is twice the wave's, later by the column's height.
Real surface_error(ElementShape shape, int cells, Real step) {
  auto stepper = column(shape, cells, step);
  stepper.start();
  const Index top = test::node_at(stepper.body().mesh(), {0, height, 0});
  Real worst = 0;
  while (stepper.time() < 0.35) {
    stepper.advance();
    const Real exact = 2 * wavelet().at(stepper.time() - height / s_wave_velocity).velocity;
    worst = std::max(worst, std::abs(stepper.state().velocity[static_cast<std::size_t>(top) * 2] - exact));
  }
  return worst;
}

TEST(column, doubles_a_wave_at_its_surface_and_lets_it_go) {
  auto stepper = column(ElementShape::quadrilateral8, 20, 1e-3);
  stepper.start();
  for (int step = 0; step < 600; ++step) stepper.advance();
  EXPECT_LT(stepper.kinetic_energy() + stepper.elastic_energy(), 1e-5 * stepper.work().waves);
  EXPECT_NEAR(stepper.energy_residual(), 0, 1e-7 * stepper.work().waves);
  EXPECT_LT(surface_error(ElementShape::quadrilateral8, 20, 5e-4), 0.02);
}

TEST(column, of_linear_ground_factorizes_its_matrix_once) {
  auto stepper = column(ElementShape::quadrilateral8, 4, 1e-3);
  stepper.start();
  for (int step = 0; step < 100; ++step) stepper.advance();
  EXPECT_EQ(stepper.factorizations(), 1);
}

TEST(column, converges_with_the_second_order) {
  const Real coarse = surface_error(ElementShape::quadrilateral4, 40, 1e-3),
             fine = surface_error(ElementShape::quadrilateral4, 80, 5e-4);
  EXPECT_NEAR(coarse / fine, 4, 0.6);
}

/// A free vibration of one mode: Newmark's step keeps the energy, an alpha takes it from fast modes.
TEST(newmark, keeps_the_energy_of_a_free_body) {
  for (const Real alpha : {0.0, -0.2}) {
    const auto mesh = test::box(ElementShape::triangle6, {{1, 4, 1}, {2, 8, 1}, 0.2});
    Supports<2> supports;
    for (int axis = 0; axis < 2; ++axis) test::hold<2>(mesh, "bottom", axis, supports);
    supports.loads = {{"push", test::traction(mesh, "top", {1e4, 0, 0}), 0}};
    FemRules rules;
    rules.step = 5e-3;
    rules.alpha = alpha;
    FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, soil())), supports, rules);
    stepper.start();
    for (int step = 0; step < 200; ++step) stepper.advance();
    if (alpha == 0)
      EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9 * stepper.kinetic_energy());
    else
      EXPECT_GT(stepper.energy_residual(), 1e-6 * stepper.kinetic_energy());
  }
}

TEST(rayleigh, damps_a_mode_by_its_ratio) {
  // A bar in shear, 1 element wide, sides held vertically: its first mode has the frequency Vs/(4 H).
  const auto mesh = test::box(ElementShape::quadrilateral8, {{1, height, 1}, {1, 10, 1}, 0});
  const Real frequency = s_wave_velocity / (4 * height), ratio = 0.05;
  Supports<2> supports;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    supports.held.push_back({static_cast<Index>(node), 1, Support::no_motion, 0});
  test::hold<2>(mesh, "bottom", 0, supports);
  supports.gravity.x() = 1;
  auto description = test::of_one_material(mesh, soil());
  description.materials[0].damping_ratio = ratio;
  FemRules rules;
  rules.step = 1e-3;
  rules.damping = laws::RayleighDamping::make(frequency, 10);
  FemStepper<2> stepper(std::make_unique<Body<2>>(std::move(description)), supports, rules);
  stepper.start();
  const Index top = test::node_at(mesh, {0, height, 0});
  // Swings about the rest: extremes alternate, and their distances shrink by exp(-pi h) in each half period.
  std::vector<Real> extremes;
  Real before = 0;
  while (extremes.size() < 4) {
    stepper.advance();
    const Real now = stepper.state().velocity[static_cast<std::size_t>(top) * 2];
    if (before * now < 0) extremes.push_back(stepper.state().displacement[static_cast<std::size_t>(top) * 2]);
    before = now;
  }
  const Real decay = (extremes[3] - extremes[2]) / (extremes[1] - extremes[2]);
  EXPECT_NEAR(-std::log(std::abs(decay)) / std::numbers::pi, ratio, 0.05 * ratio);
  EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9 * stepper.work().gravity);
}

/// How far the top of a column in shear is behind its base, which has moved steadily for a while, and the share of the work that
/// the energy balance leaves.
std::pair<Real, Real> behind_a_steady_base(bool relative, Real ratio, const laws::RayleighDamping& damping, Real speed) {
  const auto mesh = test::box(ElementShape::quadrilateral8, {{1, height, 1}, {1, 10, 1}, 0});
  Supports<2> supports;
  laws::GroundMotion steady;
  steady.shape = laws::GroundMotion::Shape::record;
  steady.quantity = laws::MotionQuantity::velocity;
  steady.record = laws::Record::make(1, {0, speed, speed, speed, speed, speed, speed, speed, speed, speed, speed});
  supports.motions = {steady};
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    supports.held.push_back({static_cast<Index>(node), 1, Support::no_motion, 0});
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    if (mesh.nodes[node].y() < 1e-9) supports.held.push_back({static_cast<Index>(node), 0, 0, 0});
  if (relative) supports.find_base();
  auto description = test::of_one_material(mesh, soil());
  description.materials[0].damping_ratio = ratio;
  FemRules rules;
  rules.step = 5e-3;
  rules.damping = damping;
  FemStepper<2> stepper(std::make_unique<Body<2>>(std::move(description)), supports, rules);
  stepper.start();
  for (int step = 0; step < 2000; ++step) stepper.advance();
  const auto along = [&](Real y) {
    return stepper.state().displacement[static_cast<std::size_t>(test::node_at(mesh, {0, y, 0})) * 2];
  };
  return {along(0) - along(height), std::abs(stepper.energy_residual()) / stepper.work().boundary};
}

TEST(rayleigh, leaves_a_column_alone_that_moves_with_its_base) {
  const Real ratio = 0.1, speed = 0.3;
  const auto damping = laws::RayleighDamping::make(2.5, 10);
  const Real drag = damping.mass_rate * ratio * speed * height * height / (2 * s_wave_velocity * s_wave_velocity);
  const auto [with_base, left] = behind_a_steady_base(true, ratio, damping, speed);
  EXPECT_NEAR(with_base, 0, 1e-6 * drag);
  EXPECT_LT(left, 1e-4);
  const auto [in_space, left_in_space] = behind_a_steady_base(false, ratio, damping, speed);
  EXPECT_NEAR(in_space, drag, 1e-6 * drag);
  EXPECT_LT(left_in_space, 1e-4);
}

/// A wall of concrete that its base carries away: its forces are small differences of displacements of many metres.
TEST(newton, finds_the_step_of_a_stiff_body_far_from_where_it_began) {
  const auto mesh = test::box(ElementShape::quadrilateral8, {{0.4, 2.5, 1}, {4, 25, 1}, 0});
  Supports<2> supports;
  laws::GroundMotion away;
  away.shape = laws::GroundMotion::Shape::sine;
  away.sine_wave = {2, 0};
  away.amplitude = 20;  // accelerations from rest: it goes on
  supports.motions = {away};
  test::hold<2>(mesh, "bottom", 0, supports, 0);
  test::hold<2>(mesh, "bottom", 1, supports);
  FemRules rules;
  rules.step = 1e-3;
  rules.alpha = -0.1;
  FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, SolidMaterial::elastic_of(25e9, 0.2, 2400))),
                        std::move(supports), rules);
  stepper.start();
  for (int step = 0; step < 1500; ++step) ASSERT_NO_THROW(stepper.advance()) << stepper.time();
  EXPECT_GT(stepper.state().displacement[0], 2);
}

/// Work and stored energy of a static step with all that can load a body: the balance closes, whether loads grow or come at once.
TEST(statics, have_a_work_balance_that_closes) {
  for (const Real ramp : {0.0, 1.0, 3.5})
    for (const bool with_weight : {false, true})
      for (const bool settles : {false, true}) {
        const auto mesh = test::box(ElementShape::triangle6, {{1, 4, 1}, {2, 8, 1}, 0.2});
        Supports<2> supports;
        laws::GroundMotion shove;
        shove.shape = laws::GroundMotion::Shape::record;
        shove.quantity = laws::MotionQuantity::displacement;
        shove.record = laws::Record::make(5, {0, 1e-3});
        supports.motions = {shove};
        test::hold<2>(mesh, "bottom", 1, supports);
        for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
          if (mesh.nodes[node].y() < 1e-9) supports.held.push_back({static_cast<Index>(node), 0, 0, 0});
        test::hold<2>(mesh, "left", 0, supports);
        supports.loads = {{"push", test::traction(mesh, "top", {1e4, -2e4, 0}), ramp}};
        if (with_weight) supports.gravity = {0, -9.81};
        FemRules rules;
        rules.step = 1;
        rules.statics = true;
        rules.tolerance = 1e-12;
        FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, soil())), supports, rules);
        if (settles) stepper.relax();
        stepper.start();
        for (int step = 0; step < 5; ++step) {
          if (step == 2) stepper.apply(test::traction(mesh, "top", {-3e3, 1e3, 0}));
          stepper.advance();
        }
        EXPECT_GT(stepper.elastic_energy(), 0);
        EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9 * stepper.elastic_energy())
            << "ramp " << ramp << ", weight " << with_weight << ", settled " << settles;
      }
}

/// All forces are round-off then, of displacements that are there at the end of the first step alone.
TEST(statics, let_a_base_carry_a_body_without_strain) {
  const auto mesh = test::box(ElementShape::quadrilateral8, {{1, 3, 1}, {3, 9, 1}, 0.2});
  Supports<2> supports;
  laws::GroundMotion shove;
  shove.shape = laws::GroundMotion::Shape::record;
  shove.quantity = laws::MotionQuantity::displacement;
  shove.record = laws::Record::make(5, {0, 0.3});
  supports.motions = {shove};
  test::hold<2>(mesh, "bottom", 0, supports, 0);
  test::hold<2>(mesh, "bottom", 1, supports);
  FemRules rules;
  rules.step = 1;
  rules.statics = true;
  FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, SolidMaterial::elastic_of(30e9, 0.2, 2500))),
                        std::move(supports), rules);
  stepper.start();
  for (int step = 0; step < 5; ++step) ASSERT_NO_THROW(stepper.advance()) << step;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) EXPECT_NEAR(stepper.state().displacement[2 * node], 0.3, 1e-12);
}

/// What is wrong there is a number of the case, and no want of equilibrium.
TEST(statics, and_dynamics_tell_of_forces_that_are_no_numbers) {
  const auto mesh = test::box(ElementShape::triangle6, {{1, 2, 1}, {1, 2, 1}, 0.2});
  for (const bool is_static : {true, false})
    for (const Real traction : {1e200, std::numeric_limits<Real>::infinity()}) {
      Supports<2> supports;
      test::hold<2>(mesh, "bottom", 0, supports);
      test::hold<2>(mesh, "bottom", 1, supports);
      supports.loads = {{"push", test::traction(mesh, "top", {0, -traction, 0}), 0}};
      FemRules rules;
      rules.step = 1e-3;
      rules.statics = is_static;
      FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, soil())), supports, rules);
      try {
        stepper.start();
        for (int step = 0; step < 3; ++step) stepper.advance();
        ADD_FAILURE() << traction;
      } catch (const PhysicsError& error) {
        const std::string words = error.what();
        EXPECT_NE(words.find("the forces are infinite, or no numbers\n  a number of the case is too large"), std::string::npos)
            << words;
        EXPECT_EQ(words.find("unbalanced"), std::string::npos) << words;
      }
    }
}

std::vector<Real> final_state(int threads) {
  parallel::set_threads(threads);
  auto mesh = test::box(ElementShape::triangle6, {{4, 4, 1}, {20, 20, 1}, 0.2});
  SolidMaterial material = soil();
  material.strength = laws::MohrCoulomb::make(1e4, 0.5, 0.1, 1e3);
  Supports<2> supports;
  for (int axis = 0; axis < 2; ++axis) test::hold<2>(mesh, "bottom", axis, supports);
  supports.gravity = {8, -9.81};
  FemRules rules;
  rules.step = 1e-2;
  FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, material)), supports, rules);
  stepper.start();
  for (int step = 0; step < 8; ++step) stepper.advance();
  EXPECT_GT(stepper.work().plastic, 0);
  parallel::set_threads(0);
  return stepper.state().displacement;
}

TEST(same_bits, for_any_number_of_threads) { EXPECT_EQ(final_state(1), final_state(3)); }

TEST(same_bits, when_a_step_is_repeated_from_a_saved_state) {
  auto mesh = test::box(ElementShape::quadrilateral4, {{2, 2, 1}, {4, 4, 1}, 0.2});
  SolidMaterial material = soil();
  material.strength = laws::MohrCoulomb::make(5e3, 0.5, 0.1, 1e3);
  Supports<2> supports;
  for (int axis = 0; axis < 2; ++axis) test::hold<2>(mesh, "bottom", axis, supports);
  supports.gravity = {8, -9.81};
  FemRules rules;
  rules.step = 1e-2;
  FemStepper<2> stepper(std::make_unique<Body<2>>(test::of_one_material(mesh, material)), supports, rules);
  stepper.start();
  for (int step = 0; step < 5; ++step) stepper.advance();
  const auto saved = stepper.state();
  stepper.apply(test::traction(mesh, "top", {3e3, 0, 0}));
  stepper.advance();
  const auto once = stepper.state().displacement;
  stepper.restore(saved);
  stepper.apply(NodalColumn(once.size(), 0));
  stepper.advance();
  EXPECT_NE(stepper.state().displacement, once);
  stepper.restore(saved);
  stepper.apply(test::traction(mesh, "top", {3e3, 0, 0}));
  stepper.advance();
  EXPECT_EQ(stepper.state().displacement, once);
}

}  // namespace
}  // namespace sazare::methods::fem
