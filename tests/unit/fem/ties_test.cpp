#include <gtest/gtest.h>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

/// Every node at x = 0 with the one at x = 1.
std::vector<std::pair<Index, Index>> left_to_right(const ElementMesh& mesh) {
  std::vector<std::pair<Index, Index>> tied;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    if (mesh.nodes[node].x() == 0)
      tied.emplace_back(static_cast<Index>(node), test::node_at(mesh, mesh.nodes[node] + Vector3::UnitX()));
  return tied;
}

/// Ground under its weight and a shear stress on its surface.
template <int D>
FemStepper<D> layer(ElementShape shape, bool is_static) {
  const ElementMesh mesh =
      test::box(shape, D == 2 ? test::BoxRules{{1, 2, 0}, {2, 4, 1}, 0} : test::BoxRules{{1, 1, 2}, {2, 1, 3}, 0});
  Supports<D> supports;
  for (int axis = 0; axis < D; ++axis) test::hold<D>(mesh, "bottom", axis, supports);
  if constexpr (D == 3)
    for (const std::string side : {"front", "back"}) test::hold<D>(mesh, side, 1, supports);
  supports.tied = left_to_right(mesh);
  supports.gravity[D - 1] = -10;
  supports.loads.push_back({"shear", test::traction(mesh, "top", Vector3(3e3, 0, 0)), 0});
  return {std::make_unique<Body<D>>(test::of_one_material(mesh, SolidMaterial::elastic_of(2e7, 0.25, 2000))), std::move(supports),
          {.step = 0.01, .statics = is_static, .damping = {}}};
}

TEST(ties, let_a_strip_stand_for_ground_without_end) {
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    auto stepper = layer<D>(shape, true);
    stepper.start();
    stepper.advance();
    // Shear stress 3 kPa everywhere, vertical stress the weight, lateral stress nu/(1 - nu) of it: exact at the middle of elements
    // whose displacement is quadratic, in the mean over elements always.
    const auto& mesh = stepper.body().mesh();
    const auto means = stepper.body().means(stepper.state().displacement, stepper.state().memory);
    Real vertical = 0, lateral = 0;
    for (std::size_t e = 0; e < means.size(); ++e) {
      const int shear = D == 2 ? 3 : 5;
      EXPECT_NEAR(means[e].stress[shear], 3e3, facts(shape).simplex ? 300 : 1e-3) << test::name_of(shape);
      vertical += means[e].stress[D - 1] / static_cast<Real>(means.size());
      lateral += means[e].stress[0] / static_cast<Real>(means.size());
    }
    EXPECT_NEAR(vertical, -2e4, facts(shape).simplex ? 500 : 1e-3) << test::name_of(shape);
    EXPECT_NEAR(lateral, vertical / 3, facts(shape).simplex ? 200 : 1e-3) << test::name_of(shape);
    for (const auto& [node, leader] : stepper.supports().tied)
      for (int axis = 0; axis < D; ++axis)
        EXPECT_EQ(stepper.state().displacement[number<D>(node, axis)], stepper.state().displacement[number<D>(leader, axis)]);
    EXPECT_LT(std::abs(stepper.energy_residual()), 1e-9 * std::abs(stepper.work().gravity));
    EXPECT_GT(mesh.nodes.size(), 0U);
  });
}

TEST(ties, keep_momentum_and_energy) {
  test::for_every_shape([&]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    auto stepper = layer<D>(shape, false);
    stepper.start();
    Real largest = 0;
    for (int step = 0; step < 50; ++step) {
      stepper.advance();
      largest = std::max(largest, stepper.kinetic_energy());
    }
    EXPECT_LT(std::abs(stepper.energy_residual()), 1e-8 * largest) << test::name_of(shape);
    for (const auto& [node, leader] : stepper.supports().tied)
      for (int axis = 0; axis < D; ++axis)
        EXPECT_EQ(stepper.state().velocity[number<D>(node, axis)], stepper.state().velocity[number<D>(leader, axis)]);
  });
}

/// A beam that goes on alike, on supports and with a force in the middle of every span, is clamped at its supports.
TEST(ties, hold_the_rotations_of_beams) {
  BodyDescription description;
  description.mesh.dimension = 2;
  MemberSet beam{.name = "beam", .kind = MemberKind::beam};
  beam.youngs_modulus = 2e11;
  beam.area = 1e-2;
  beam.second_moment = 2e-5;
  beam.density = 7850;
  for (Index i = 0; i <= 4; ++i) {
    description.mesh.nodes.emplace_back(i, 0, 0);
    description.mesh.node_tags.push_back(i + 1);
    if (i > 0) beam.lines.push_back({i - 1, i});
  }
  description.members = {beam};
  Supports<2> supports;
  for (const Index node : {0, 4})
    for (const int axis : {0, 1}) supports.held.push_back({node, axis, Support::no_motion, 0});
  supports.tied = {{0, 4}};
  FemStepper<2> stepper(std::make_unique<Body<2>>(std::move(description)), supports, {.step = 1, .statics = true, .damping = {}});
  stepper.start();
  stepper.apply({0, 0, 0, 0, 0, -1000, 0, 0, 0, 0});
  stepper.advance();
  EXPECT_NEAR(stepper.state().displacement[5], -1000 * 64 / (192 * 2e11 * 2e-5), 1e-12);
}

}  // namespace
}  // namespace sazare::methods::fem
