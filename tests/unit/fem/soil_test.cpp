#include <gtest/gtest.h>

#include "sazare/parallel/threads.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

constexpr Real modulus = 2e7, reference = 1e-3, density = 2000, height = 10;

SolidMaterial soil() {
  SolidMaterial material = SolidMaterial::elastic_of(2.8 * modulus, 0.4, density);
  material.backbone = laws::hyperbolic_curve(material.elastic.shear_modulus, reference, modulus * reference, 30);
  return material;
}

template <int D>
void hold_all(const ElementMesh& mesh, int axis, Supports<D>& supports) {
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    supports.held.push_back({static_cast<Index>(node), axis, Support::no_motion, 0});
}

laws::GroundMotion displacement(std::vector<Real> values) {
  laws::GroundMotion motion;
  motion.shape = laws::GroundMotion::Shape::record;
  motion.quantity = laws::MotionQuantity::displacement;
  motion.record = laws::Record::make(1, std::move(values));
  return motion;
}

/// A cube whose top follows shear strains, one in each step, in equilibrium.
template <int D>
FemStepper<D> sheared(ElementShape shape, std::vector<Real> strains) {
  const auto mesh = test::box(shape, {{1, 1, 1}, {2, 2, 2}, 0});
  Supports<D> supports;
  supports.motions = {displacement(std::move(strains))};
  for (int axis = 1; axis < D; ++axis) hold_all<D>(mesh, axis, supports);
  test::hold<D>(mesh, "bottom", 0, supports);
  test::hold<D>(mesh, "top", 0, supports, 0);
  FemRules rules;
  rules.step = 1;
  rules.tolerance = 1e-12;
  rules.statics = true;
  return FemStepper<D>(std::make_unique<Body<D>>(test::of_one_material(mesh, soil())), std::move(supports), rules);
}

template <int D>
Real force(const FemStepper<D>& stepper) {
  Real sum = 0;
  const auto reactions = stepper.reactions();
  for (const Support& support : stepper.supports().held)
    if (support.motion == 0) sum += reactions[static_cast<std::size_t>(support.node) * D];
  return sum;
}

template <int D>
void check_backbone(ElementShape shape) {
  std::vector<Real> strains{0};
  for (const Real strain : laws::spaced_strains(0.02 * reference, 50 * reference, 30)) strains.push_back(strain);
  auto stepper = sheared<D>(shape, strains);
  stepper.start();
  for (std::size_t i = 1; i < strains.size(); ++i) {
    stepper.advance();
    const Real exact = modulus * strains[i] / (1 + strains[i] / reference);
    EXPECT_NEAR(force(stepper), exact, 1e-9 * exact);
  }
  EXPECT_NEAR(stepper.energy_residual(), 0, 1e-10 * stepper.work().boundary);
}

TEST(soil, in_shear_follows_its_backbone) {
  check_backbone<2>(ElementShape::quadrilateral4);
  check_backbone<2>(ElementShape::triangle6);
  check_backbone<3>(ElementShape::hexahedron8);
}

/// Steps that meet every corner of the loop between -a and a: its area is then exact.
TEST(soil, dissipates_the_loop_of_masing) {
  const laws::BackboneCurve curve = *soil().backbone;
  const Real a = 3e-3;
  std::vector<Real> strains{0, a};
  const auto branch = [&](Real from, Real to) {
    for (const Real corner : curve.corner_strain())
      if (corner < a) strains.push_back(from + (to > from ? 2 : -2) * corner);
    strains.push_back(to);
  };
  branch(a, -a);
  branch(-a, a);
  const std::size_t first = strains.size();
  branch(a, -a);
  branch(-a, a);
  auto stepper = sheared<2>(ElementShape::quadrilateral8, strains);
  stepper.start();
  Real before = 0;
  for (std::size_t i = 1; i < strains.size(); ++i) {
    stepper.advance();
    if (i + 1 == first) before = stepper.work().plastic;
  }
  const Real loop = 8 * (curve.area(a) - 0.5 * a * curve.stress(a));
  EXPECT_NEAR(stepper.work().plastic - before, loop, 1e-9 * loop);
  EXPECT_NEAR(stepper.energy_residual(), 0, 1e-9 * loop);
}

/// A column in shear under a strong push, then free.
FemStepper<2> column(Real push, int across = 1) {
  const auto mesh = test::box(ElementShape::quadrilateral8, {{1.0 * across, height, 1}, {across, 20, 1}, 0});
  Supports<2> supports;
  hold_all<2>(mesh, 1, supports);
  test::hold<2>(mesh, "bottom", 0, supports);
  supports.loads = {{"push", test::traction(mesh, "top", {push, 0, 0}), 0.1}};
  FemRules rules;
  rules.step = 5e-3;
  rules.tolerance = 1e-10;
  return FemStepper<2>(std::make_unique<Body<2>>(test::of_one_material(mesh, soil())), std::move(supports), rules);
}

TEST(soil, closes_the_balance_of_energy_in_motion) {
  auto stepper = column(0.5 * modulus * reference);
  stepper.start();
  Real plastic = 0;
  for (int step = 0; step < 300; ++step) {
    stepper.advance();
    EXPECT_GE(stepper.work().plastic, plastic * (1 - 1e-12));
    plastic = stepper.work().plastic;
  }
  EXPECT_GT(plastic, 0.1 * stepper.work().loads);
  EXPECT_NEAR(stepper.energy_residual(), 0, 1e-8 * stepper.work().loads);
}

/// Below the first corner nothing yields.
TEST(soil, under_a_small_push_is_elastic) {
  auto soft = column(1e-3 * modulus * reference);
  soft.start();
  SolidMaterial elastic = soil();
  elastic.backbone.reset();
  FemStepper<2> linear(std::make_unique<Body<2>>(test::of_one_material(soft.body().mesh(), elastic)), soft.supports(),
                       soft.rules());
  linear.start();
  Real most = 0, worst = 0;
  for (int step = 0; step < 100; ++step) {
    soft.advance();
    linear.advance();
    for (std::size_t i = 0; i < soft.state().displacement.size(); ++i) {
      most = std::max(most, std::abs(linear.state().displacement[i]));
      worst = std::max(worst, std::abs(linear.state().displacement[i] - soft.state().displacement[i]));
    }
  }
  EXPECT_EQ(soft.work().plastic, 0);
  EXPECT_LT(worst, 1e-9 * most);
}

TEST(soil, has_the_same_bits_with_any_number_of_threads_and_after_a_return) {
  const auto walk = [](int threads) {
    parallel::set_threads(threads);
    auto stepper = column(0.5 * modulus * reference, 5);
    stepper.start();
    for (int step = 0; step < 30; ++step) stepper.advance();
    const auto saved = stepper.state();
    for (int step = 0; step < 10; ++step) stepper.advance();
    const auto first = stepper.state().memory.solids;
    stepper.restore(saved);
    for (int step = 0; step < 10; ++step) stepper.advance();
    EXPECT_EQ(first, stepper.state().memory.solids);
    return std::pair(stepper.state().displacement, stepper.state().memory.solids);
  };
  const auto one = walk(1), three = walk(3);
  parallel::set_threads(0);
  EXPECT_EQ(one, three);
}

/// Its means tell the largest shear strain.
TEST(soil, tells_its_largest_shear_strain) {
  auto stepper = sheared<2>(ElementShape::quadrilateral8, {0, 2e-3, -1e-3});
  stepper.start();
  for (int step = 0; step < 2; ++step) stepper.advance();
  for (const auto& mean : stepper.body().means(stepper.state().displacement, stepper.state().memory)) {
    EXPECT_NEAR(mean.peak, 2e-3, 1e-12);
    EXPECT_NEAR(mean.stress[3], force(stepper), 1e-9 * modulus * reference);
  }
}

}  // namespace
}  // namespace sazare::methods::fem
