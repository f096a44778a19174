#include "sazare/methods/fem/shape_functions.hpp"

#include <gtest/gtest.h>

#include "sazare/methods/fem/boundary_faces.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape;

using geometry::facts;
using test::for_every_shape, test::name_of;

constexpr Real small = 1e-13;

TEST(shape_functions, are_one_at_their_own_node_and_sum_to_one) {
  for_every_shape([](ElementShape shape, auto) {
    const auto nodes = geometry::reference_nodes(shape);
    ASSERT_EQ(static_cast<int>(nodes.size()), facts(shape).nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t k = 0; k < nodes.size(); ++k)
        EXPECT_NEAR(shape_values(shape, nodes[k])[static_cast<Eigen::Index>(i)], i == k ? 1 : 0, small) << name_of(shape);
    const Vector3 place(0.21, 0.33, facts(shape).dimension == 3 ? 0.17 : 0);
    EXPECT_NEAR(shape_values(shape, place).sum(), 1, small);
    EXPECT_NEAR(shape_gradients(shape, place).colwise().sum().norm(), 0, small);
  });
}

TEST(shape_functions, have_the_gradients_of_their_values) {
  for_every_shape([]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    const Vector3 place(0.21, 0.33, D == 3 ? 0.17 : 0);
    for (int axis = 0; axis < D; ++axis) {
      const Real step = 1e-5;
      const Vector3 more = place + step * Vector3::Unit(axis), less = place - step * Vector3::Unit(axis);
      const NodeValues slope = (shape_values(shape, more) - shape_values(shape, less)) / (2 * step);
      EXPECT_LT((slope - shape_gradients(shape, place).col(axis)).norm(), 1e-9) << name_of(shape);
    }
  });
}

/// The integral of x^i y^j z^k over the reference element.
Real exact(ElementShape shape, int i, int j, int k) {
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  const int dimension = facts(shape).dimension;
  if (facts(shape).simplex) return factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + dimension);
  Real product = 1;
  for (const int power : dimension == 3 ? std::vector{i, j, k} : std::vector{i, j})
    product *= power % 2 == 1 ? 0 : 2.0 / (power + 1);
  return product;
}

Real sum(std::span<const QuadraturePoint> points, int i, int j, int k) {
  Real total = 0;
  for (const QuadraturePoint& point : points)
    total += point.weight * std::pow(point.place.x(), i) * std::pow(point.place.y(), j) * std::pow(point.place.z(), k);
  return total;
}

TEST(quadrature, integrates_its_degree_exactly) {
  for_every_shape([]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    const int order = facts(shape).quadratic ? 2 : 1;
    const auto check = [&](std::span<const QuadraturePoint> points, int degree) {
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; i + j <= degree; ++j)
          for (int k = 0; i + j + k <= (D == 3 ? degree : i + j); ++k)
            EXPECT_NEAR(sum(points, i, j, k), exact(shape, i, j, k), 1e-14) << name_of(shape) << i << j << k;
      for (const QuadraturePoint& point : points) EXPECT_GT(point.weight, 0);
    };
    check(stiffness_points(shape, Integration::full), 2 * order - 2);
    check(stiffness_points(shape, Integration::reduced), 2 * order - 2);
    check(mass_points(shape), 2 * order);
  });
}

TEST(quadrature, of_joints_is_exact_for_linear_pressures) {
  for (const ElementShape shape :
       {ElementShape::triangle3, ElementShape::triangle6, ElementShape::quadrilateral4, ElementShape::quadrilateral9})
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {0, 1}})
      EXPECT_NEAR(sum(nodal_points(shape), i, j, 0), exact(shape, i, j, 0), 1e-14) << name_of(shape);
}

TEST(faces, look_outwards_and_enclose_the_volume) {
  for_every_shape([]<int D>(ElementShape shape, std::integral_constant<int, D>) {
    const auto mesh = test::box(shape, {{2, 3, 4}, {1, 1, 1}, 0});
    // The divergence theorem for the field x.
    Real volume = 0;
    for (const auto& group : mesh.groups)
      for (const auto& face : group.elements)
        for (const QuadraturePoint& place : mass_points(face.shape)) {
          const auto point = face_point<D>(mesh, face, place);
          Vector<D> x = Vector<D>::Zero();
          for (std::size_t i = 0; i < face.node_list().size(); ++i)
            x += point.values[static_cast<Eigen::Index>(i)] *
                 mesh.nodes[static_cast<std::size_t>(face.nodes[i])].template head<D>();
          volume += point.weight * point.normal.dot(x) / D;
        }
    EXPECT_NEAR(volume, D == 2 ? 6 : 24, 1e-12) << name_of(shape);
  });
}

}  // namespace
}  // namespace sazare::methods::fem
