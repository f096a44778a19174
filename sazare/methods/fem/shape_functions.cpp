#include "sazare/methods/fem/shape_functions.hpp"

#include <Eigen/LU>
#include <cmath>

namespace sazare::methods::fem {
namespace {

using geometry::ElementShape;
using geometry::facts;

using Powers = std::array<int, 3>;

/// Monomials that a shape's functions are made of: on simplices all up to its order; else all with powers up to its order, of
/// which at most one is 2 where the element has no nodes inside its faces (serendipity).
std::vector<Powers> monomials_of(ElementShape shape) {
  const auto& about = facts(shape);
  const int order = about.quadratic ? 2 : 1;
  const bool serendipity = shape == ElementShape::quadrilateral8 || shape == ElementShape::hexahedron20;
  std::vector<Powers> monomials;
  for (int i = 0; i <= order; ++i)
    for (int j = 0; j <= (about.dimension > 1 ? order : 0); ++j)
      for (int k = 0; k <= (about.dimension > 2 ? order : 0); ++k) {
        if (about.dimension == 0 && i > 0) continue;
        if (about.simplex && i + j + k > order) continue;
        if (serendipity && (i == 2) + (j == 2) + (k == 2) > 1) continue;
        monomials.push_back({i, j, k});
      }
  return monomials;
}

Real power(Real base, int exponent) { return exponent == 0 ? 1 : exponent == 1 ? base : base * base; }
Real slope(Real base, int exponent) { return exponent == 0 ? 0 : exponent == 1 ? 1 : 2 * base; }

/// The shape functions as sums of monomials: those that are 1 at their own node and 0 at all others.
struct Basis {
  std::vector<Powers> monomials;
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> coefficient;  ///< (node, monomial)

  explicit Basis(ElementShape shape) : monomials(monomials_of(shape)) {
    const auto nodes = geometry::reference_nodes(shape);
    Eigen::MatrixXd values(nodes.size(), monomials.size());
    for (std::size_t node = 0; node < nodes.size(); ++node)
      for (std::size_t m = 0; m < monomials.size(); ++m)
        values(static_cast<Eigen::Index>(node), static_cast<Eigen::Index>(m)) = value(m, nodes[node]);
    // They are multiples of 1/8 on these nodes; rounding to them takes off what the inverse left.
    coefficient = (64 * values.inverse().transpose().array()).round() / 64;
  }

  Real value(std::size_t m, const Vector3& at) const {
    return power(at.x(), monomials[m][0]) * power(at.y(), monomials[m][1]) * power(at.z(), monomials[m][2]);
  }
  Vector3 gradient(std::size_t m, const Vector3& at) const {
    const auto [i, j, k] = monomials[m];
    return {slope(at.x(), i) * power(at.y(), j) * power(at.z(), k), power(at.x(), i) * slope(at.y(), j) * power(at.z(), k),
            power(at.x(), i) * power(at.y(), j) * slope(at.z(), k)};
  }
};

/// One entry for every shape, made at the first call.
template <class Item, class Make>
const Item& entry_of(ElementShape shape, Make make) {
  static const std::vector<Item> table = [&] {
    std::vector<Item> items;
    for (std::size_t i = 0; i < geometry::element_shape_count; ++i) items.push_back(make(static_cast<ElementShape>(i)));
    return items;
  }();
  return table[static_cast<std::size_t>(shape)];
}

const Basis& basis_of(ElementShape shape) {
  return entry_of<Basis>(shape, [](ElementShape one) { return Basis(one); });
}

using Points = std::vector<QuadraturePoint>;
using Rule = std::vector<std::pair<Real, Real>>;  ///< places and weights from -1 to 1

/// Gauss and Legendre's points of 1 to 4.
Rule gauss(int count) {
  const Real a = std::sqrt(3.0 / 5), b = std::sqrt(6.0 / 5) * 2 / 7;
  const Real inner = std::sqrt(3.0 / 7 - b), outer = std::sqrt(3.0 / 7 + b), root = std::sqrt(30.0);
  if (count == 1) return {{0, 2}};
  if (count == 2) return {{-1 / std::sqrt(3.0), 1}, {1 / std::sqrt(3.0), 1}};
  if (count == 3) return {{-a, 5.0 / 9}, {0, 8.0 / 9}, {a, 5.0 / 9}};
  return {{-outer, (18 - root) / 36}, {-inner, (18 + root) / 36}, {inner, (18 + root) / 36}, {outer, (18 - root) / 36}};
}

/// The ends, and with three the middle: Simpson's.
Rule at_nodes(int count) {
  if (count == 2) return {{-1, 1}, {1, 1}};
  return {{-1, 1.0 / 3}, {0, 4.0 / 3}, {1, 1.0 / 3}};
}

Points product(const Rule& rule, int dimension) {
  Points points = {{Vector3::Zero(), 1}};
  for (int axis = 0; axis < dimension; ++axis) {
    Points next;
    for (const QuadraturePoint& point : points)
      for (const auto& [place, weight] : rule) {
        next.push_back({point.place, point.weight * weight});
        next.back().place[axis] = place;
      }
    points = std::move(next);
  }
  return points;
}

/// Gauss's points of a square or cube folded onto the triangle or tetrahedron.
Points folded(int count, int dimension) {
  Points points;
  for (const QuadraturePoint& point : product(gauss(count), dimension)) {
    const Real u = 0.5 * (1 + point.place.x()), v = 0.5 * (1 + point.place.y()), w = 0.5 * (1 + point.place.z());
    if (dimension == 2)
      points.push_back({{u, v * (1 - u), 0}, point.weight / 4 * (1 - u)});
    else
      points.push_back({{u, v * (1 - u), w * (1 - u) * (1 - v)}, point.weight / 8 * (1 - u) * (1 - u) * (1 - v)});
  }
  return points;
}

/// Points with one of the barycentric coordinates `far` and all others equal, and their common weight.
Points around_corners(Real far, int dimension, Real weight) {
  const Real near = (1 - far) / dimension;
  Points points;
  for (int corner = 0; corner <= dimension; ++corner) {
    QuadraturePoint point{Vector3::Zero(), weight};
    for (int axis = 0; axis < dimension; ++axis) point.place[axis] = axis + 1 == corner ? far : near;
    points.push_back(point);
  }
  return points;
}

/// For a degree of 2. Strang and Fix, An Analysis of the Finite Element Method (1973), table 4.1; in space Keast (1986).
Points simplex_stiffness_points(const geometry::ShapeFacts& about) {
  if (about.dimension == 2) return around_corners(2.0 / 3, 2, 1.0 / 6);
  return around_corners((5 + 3 * std::sqrt(5.0)) / 20, 3, 1.0 / 24);
}

Points make_stiffness_points(ElementShape shape, Integration integration) {
  const auto& about = facts(shape);
  if (about.dimension == 0) return {{Vector3::Zero(), 1}};
  if (about.simplex && !about.quadratic) {
    const Real share = 1.0 / (about.dimension + 1);
    Vector3 centre = Vector3::Zero();
    for (int axis = 0; axis < about.dimension; ++axis) centre[axis] = share;
    return {{centre, about.dimension == 2 ? 0.5 : 1.0 / 6}};
  }
  if (about.simplex) return simplex_stiffness_points(about);
  const bool may_reduce =
      shape == ElementShape::line3 || shape == ElementShape::quadrilateral8 || shape == ElementShape::hexahedron20;
  const bool fewer = !about.quadratic || (may_reduce && integration == Integration::reduced);
  return product(gauss(fewer ? 2 : 3), about.dimension);
}

Points make_mass_points(ElementShape shape) {
  const auto& about = facts(shape);
  if (about.dimension == 0) return {{Vector3::Zero(), 1}};
  if (about.simplex) return folded(about.quadratic ? 4 : 3, about.dimension);
  return product(gauss(about.quadratic ? 3 : 2), about.dimension);
}

/// Corners 1/20, middles 2/15 and the centre 9/20 of the area are exact to degree 3.
Points make_nodal_points(ElementShape shape) {
  const auto& about = facts(shape);
  if (!about.simplex) return product(at_nodes(about.quadratic ? 3 : 2), about.dimension);
  Points points;
  const auto nodes = geometry::reference_nodes(shape);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    points.push_back({nodes[i], 0.5 * (!about.quadratic ? 1.0 / 3 : i < 3 ? 1.0 / 20 : 2.0 / 15)});
  if (about.quadratic) points.push_back({{1.0 / 3, 1.0 / 3, 0}, 0.5 * 9.0 / 20});
  return points;
}

}  // namespace

NodeValues shape_values(ElementShape shape, const Vector3& place) {
  const Basis& basis = basis_of(shape);
  NodeValues values = NodeValues::Zero(basis.coefficient.rows());
  for (std::size_t m = 0; m < basis.monomials.size(); ++m)
    values += basis.value(m, place) * basis.coefficient.col(static_cast<Eigen::Index>(m));
  return values;
}

NodeGradients shape_gradients(ElementShape shape, const Vector3& place) {
  const Basis& basis = basis_of(shape);
  NodeGradients gradients = NodeGradients::Zero(basis.coefficient.rows(), 3);
  for (std::size_t m = 0; m < basis.monomials.size(); ++m) {
    const Vector3 gradient = basis.gradient(m, place);
    for (int axis = 0; axis < 3; ++axis)
      gradients.col(axis) += gradient[axis] * basis.coefficient.col(static_cast<Eigen::Index>(m));
  }
  return gradients;
}

std::span<const QuadraturePoint> stiffness_points(ElementShape shape, Integration integration) {
  if (integration == Integration::full)
    return entry_of<Points>(shape, [](ElementShape one) { return make_stiffness_points(one, Integration::full); });
  return entry_of<Points>(shape, [](ElementShape one) { return make_stiffness_points(one, Integration::reduced); });
}

std::span<const QuadraturePoint> mass_points(ElementShape shape) {
  return entry_of<Points>(shape, [](ElementShape one) { return make_mass_points(one); });
}

std::span<const QuadraturePoint> nodal_points(ElementShape shape) {
  return entry_of<Points>(shape, [](ElementShape one) { return make_nodal_points(one); });
}

}  // namespace sazare::methods::fem
