/// Patch tests: a linear field of displacements is found exactly on a distorted mesh.

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

using methods::fem::FemRules, methods::fem::FemStepper;
using test::for_every_shape, test::name_of;

constexpr Real modulus = 1e7, ratio = 0.3;

const Matrix3 field = (Matrix3() << 1e-3, 3e-4, -2e-4, -5e-4, -7e-4, 4e-4, 6e-4, 1e-4, 2e-4).finished();

bool on_the_outside(const Vector3& place, const Vector3& size, int dimension) {
  for (int axis = 0; axis < dimension; ++axis)
    if (place[axis] < 1e-9 || place[axis] > size[axis] - 1e-9) return true;
  return false;
}

template <int D>
void check_patch(ElementShape shape, Integration integration) {
  const Vector3 size(2, 1.5, 1);
  const auto mesh = test::box(shape, {size, {3, 3, 3}, 0.35});
  auto description = test::of_one_material(mesh, SolidMaterial::elastic_of(modulus, ratio, 2000));
  description.integration = integration;
  Supports<D> supports;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (!on_the_outside(mesh.nodes[node], size, D)) continue;
    for (int axis = 0; axis < D; ++axis) {
      laws::GroundMotion motion;
      motion.shape = laws::GroundMotion::Shape::record;
      motion.quantity = laws::MotionQuantity::displacement;
      motion.record =
          laws::Record::make(1, {0, (field.template topLeftCorner<D, D>() * mesh.nodes[node].template head<D>())[axis]});
      supports.held.push_back({static_cast<Index>(node), axis, static_cast<Index>(supports.motions.size()), 0});
      supports.motions.push_back(motion);
    }
  }
  FemRules rules;
  rules.step = 1;
  rules.statics = true;
  FemStepper<D> stepper(std::make_unique<Body<D>>(std::move(description)), std::move(supports), rules);
  stepper.start();
  stepper.advance();
  ASSERT_GT(stepper.free_freedoms(), 0U);
  Real largest = 0;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const Vector<D> exact = field.template topLeftCorner<D, D>() * mesh.nodes[node].template head<D>();
    for (int axis = 0; axis < D; ++axis)
      largest =
          std::max(largest, std::abs(stepper.state().displacement[node * D + static_cast<std::size_t>(axis)] - exact[axis]));
  }
  EXPECT_LT(largest, 1e-14) << name_of(shape);  // displacements are some 1e-3 m
  Voigt<D> strain = Voigt<D>::Zero();
  for (int a = 0; a < D; ++a) strain += strain_operator<D>(Vector<D>::Unit(a)) * field.template topLeftCorner<D, D>().col(a);
  const Voigt<D> exact = elastic_stiffness<D>(SolidMaterial::elastic_of(modulus, ratio, 1).elastic) * strain;
  for (const auto& one : stepper.body().means(stepper.state().displacement, stepper.state().memory))
    EXPECT_LT((one.stress - exact).norm(), 1e-10 * exact.norm()) << name_of(shape);
}

TEST(patch, every_element_carries_a_uniform_strain_on_a_distorted_mesh) {
  for_every_shape([]<int D>(ElementShape shape, std::integral_constant<int, D>) { check_patch<D>(shape, Integration::full); });
}

TEST(patch, so_do_elements_with_reduced_integration) {
  check_patch<2>(ElementShape::quadrilateral8, Integration::reduced);
  check_patch<3>(ElementShape::hexahedron20, Integration::reduced);
}

TEST(stiffness, has_the_rigid_body_modes_and_no_other) {
  for_every_shape([]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    const auto mesh = test::box(shape, {{1, 1.2, 0.9}, {1, 1, 1}, 0});
    const Eigen::MatrixXd k =
        element_stiffness<D>(mesh, mesh.elements[0], SolidMaterial::elastic_of(1, ratio, 1), Integration::full);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
    constexpr int modes = D == 2 ? 3 : 6;
    EXPECT_LT(values.head(modes).cwiseAbs().maxCoeff(), 1e-13) << name_of(shape);
    EXPECT_GT(values[modes], 1e-4) << name_of(shape);
  });
}

/// The stiffness of the first element of a mesh, found with the stack moved by a multiple of the smallest alignment.
template <int D>
Eigen::MatrixXd stiffness_with_the_stack_moved(const ElementMesh& mesh, std::size_t bytes) {
  volatile char* moved = static_cast<char*>(__builtin_alloca(bytes));
  moved[0] = 0;
  return element_stiffness<D>(mesh, mesh.elements[0], SolidMaterial::elastic_of(1, ratio, 1), Integration::full);
}

/// Addresses differ from run to run and from thread to thread.
TEST(stiffness, has_the_same_bits_wherever_in_memory_it_is_found) {
  for_every_shape([]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    const auto mesh = test::box(shape, {{1, 1.2, 0.9}, {2, 2, 2}, 0.3});
    const Eigen::MatrixXd first = stiffness_with_the_stack_moved<D>(mesh, 16);
    for (const std::size_t bytes : {32, 48, 64}) {
      const Eigen::MatrixXd other = stiffness_with_the_stack_moved<D>(mesh, bytes);
      EXPECT_TRUE((first.array() == other.array()).all()) << name_of(shape);
    }
  });
}

TEST(mass, sums_to_density_times_volume_and_keeps_the_centre) {
  for (const MassMatrix kind : {MassMatrix::consistent, MassMatrix::lumped})
    for_every_shape([kind]<int D>(ElementShape shape, std::integral_constant<int, D>) {
      const auto mesh = test::box(shape, {{2, 1.5, 1}, {2, 2, 2}, 0.3});
      auto description = test::of_one_material(mesh, SolidMaterial::elastic_of(1, ratio, 2000));
      description.mass = kind;
      const Body<D> body(std::move(description));
      EXPECT_NEAR(body.total_mass(), 2000 * (D == 2 ? 3 : 3), 1e-8) << name_of(shape);
    });
}

TEST(mass, lumped_has_no_negative_part) {
  for_every_shape([]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    const auto mesh = test::box(shape, {{1, 1, 1}, {1, 1, 1}, 0});
    const Eigen::MatrixXd m = element_mass<D>(mesh, mesh.elements[0], SolidMaterial::elastic_of(1, 0, 1), MassMatrix::lumped);
    EXPECT_GT(m.diagonal().minCoeff(), 0) << name_of(shape);
    EXPECT_NEAR((m - Eigen::MatrixXd(m.diagonal().asDiagonal())).norm(), 0, 1e-15);
  });
}

TEST(solver, names_a_freedom_that_nothing_holds) {
  const auto mesh = test::box(ElementShape::quadrilateral4, {{2, 1, 1}, {2, 1, 1}, 0});
  Supports<2> supports;
  test::hold<2>(mesh, "bottom", 1, supports);
  FemRules rules;
  rules.step = 1;
  const auto description = test::of_one_material(mesh, SolidMaterial::elastic_of(modulus, ratio, 2000));
  FemStepper<2> loose(std::make_unique<Body<2>>(description), supports, rules);
  const auto found = loose.find_loose_freedom();
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->axis, 0);
  test::hold<2>(mesh, "left", 0, supports);
  FemStepper<2> firm(std::make_unique<Body<2>>(description), supports, rules);
  EXPECT_FALSE(firm.find_loose_freedom().has_value());
}

}  // namespace
}  // namespace sazare::methods::fem
