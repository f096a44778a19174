#include "sazare/methods/fem/wet_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sazare::methods::fem {
namespace {

using geometry::ElementMesh, geometry::ElementShape, geometry::MeshElement;
using Points = std::vector<QuadraturePoint>;

constexpr int most_halvings = 7;
constexpr Real straight = 1e-12;  ///< of the largest depth: so far from linear is round-off

/// Depth of a face's places below the level.
class FaceDepth {
public:
  FaceDepth(const ElementMesh& mesh, const MeshElement& face, const laws::WaterPressure& water)
      : mesh_(mesh), face_(face), water_(water) {
    for (const Index node : face.node_list()) {
      const Real depth = water.depth(mesh.nodes[at(node)]);
      least_ = std::min(least_, depth);
      most_ = std::max(most_, depth);
    }
  }

  Vector3 place(const Vector3& reference) const {
    const NodeValues values = shape_values(face_.shape, reference);
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < face_.node_list().size(); ++i)
      sum += values[static_cast<Eigen::Index>(i)] * mesh_.nodes[at(face_.nodes[i])];
    return sum;
  }
  Real operator()(const Vector3& reference) const { return water_.depth(place(reference)); }

  bool all_wet() const { return least_ >= 0; }
  bool all_dry() const { return most_ <= 0; }
  Real size() const { return std::max(most_, -least_); }

private:
  const ElementMesh& mesh_;
  const MeshElement& face_;
  const laws::WaterPressure& water_;
  Real least_ = std::numeric_limits<Real>::infinity(), most_ = -least_;
};

/// Where a + b x + c x^2 is 0 between -1 and 1, ascending.
std::vector<Real> roots(Real a, Real b, Real c) {
  std::vector<Real> found;
  const Real root = std::sqrt(std::max(b * b - 4 * a * c, Real{0}));
  const Real half = -0.5 * (b + std::copysign(root, b));  // without cancellation
  if (b * b >= 4 * a * c) {
    if (half != 0) found.push_back(a / half);
    if (c != 0) found.push_back(half / c);
  }
  std::erase_if(found, [](Real x) { return !(x > -1 && x < 1); });
  std::ranges::sort(found);
  return found;
}

/// Along a line of 2 or 3 nodes the depth is a polynomial.
Points on_line(const FaceDepth& depth) {
  const Real start = depth({-1, 0, 0}), middle = depth({0, 0, 0}), end = depth({1, 0, 0});
  Real bend = 0.5 * (start + end) - middle;
  if (std::abs(bend) <= straight * depth.size()) bend = 0;
  std::vector<Real> cuts = {-1};
  for (const Real root : roots(middle, 0.5 * (end - start), bend)) cuts.push_back(root);
  cuts.push_back(1);
  Points points;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Real centre = 0.5 * (cuts[i] + cuts[i + 1]), half = 0.5 * (cuts[i + 1] - cuts[i]);
    if (depth({centre, 0, 0}) <= 0) continue;
    for (const QuadraturePoint& point : mass_points(ElementShape::line3))
      points.push_back({{centre + half * point.place.x(), 0, 0}, half * point.weight});
  }
  return points;
}

struct Corner {
  Vector3 place;  ///< reference coordinates
  Real depth = 0;
};
using Triangle = std::array<Corner, 3>;

void add_triangle(const Triangle& triangle, Points& points) {
  const Vector3 first = triangle[1].place - triangle[0].place, second = triangle[2].place - triangle[0].place;
  const Real measure = first.cross(second).norm();
  for (const QuadraturePoint& point : mass_points(ElementShape::triangle6))
    points.push_back({triangle[0].place + point.place.x() * first + point.place.y() * second, measure * point.weight});
}

/// The part of a triangle where the depth, linear in it, is positive.
void add_wet_part(const Triangle& triangle, Points& points) {
  std::vector<Corner> wet;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &here = triangle[i], &next = triangle[(i + 1) % 3];
    if (here.depth >= 0) wet.push_back(here);
    if ((here.depth < 0) == (next.depth < 0)) continue;
    const Real share = here.depth / (here.depth - next.depth);
    wet.push_back({here.place + share * (next.place - here.place), 0});
  }
  for (std::size_t i = 2; i < wet.size(); ++i) add_triangle({wet[0], wet[i - 1], wet[i]}, points);
}

void add_wet_points(const FaceDepth& depth, const Triangle& triangle, int halvings_left, Points& points) {
  std::array<Corner, 3> middle;
  bool is_straight = true, wet = true, dry = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &one = triangle[i], &other = triangle[(i + 1) % 3];
    middle[i].place = 0.5 * (one.place + other.place);
    middle[i].depth = depth(middle[i].place);
    is_straight = is_straight && std::abs(middle[i].depth - 0.5 * (one.depth + other.depth)) <= straight * depth.size();
    wet = wet && one.depth >= 0 && middle[i].depth >= 0;
    dry = dry && one.depth <= 0 && middle[i].depth <= 0;
  }
  if (dry) return;
  if (wet) return add_triangle(triangle, points);
  if (is_straight || halvings_left == 0) return add_wet_part(triangle, points);
  for (std::size_t i = 0; i < 3; ++i)
    add_wet_points(depth, {triangle[i], middle[i], middle[(i + 2) % 3]}, halvings_left - 1, points);
  add_wet_points(depth, middle, halvings_left - 1, points);
}

/// Corners of the reference element.
std::vector<Vector3> corners(ElementShape shape) {
  if (geometry::facts(shape).simplex) return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
}

/// Mass per area at a point, and all that a face's mass matrix is made of.
template <int D>
struct MovingPoint {
  FacePoint<D> face;
  Real mass = 0;  ///< [kg]
};

template <int D>
std::vector<MovingPoint<D>> moving_points(const ElementMesh& mesh, const MeshElement& face, const laws::WaterPressure& water,
                                          Real density, Real water_depth) {
  const FaceDepth depth(mesh, face, water);
  std::vector<MovingPoint<D>> points;
  for (const QuadraturePoint& place : wet_points(mesh, face, water)) {
    const FacePoint<D> point = face_point<D>(mesh, face, place);
    points.push_back({point, point.weight * laws::westergaard_mass(density, water_depth, depth(place.place))});
  }
  return points;
}

}  // namespace

std::vector<QuadraturePoint> wet_points(const ElementMesh& mesh, const MeshElement& face, const laws::WaterPressure& water) {
  const FaceDepth depth(mesh, face, water);
  if (geometry::facts(face.shape).dimension == 1) return on_line(depth);
  if (depth.all_dry()) return {};
  if (depth.all_wet()) {
    const bool triangle =
        geometry::facts(face.shape).simplex;  // the root of an added mass takes more points than its nodes would
    const auto points = mass_points(triangle ? ElementShape::triangle6 : ElementShape::quadrilateral9);
    return {points.begin(), points.end()};
  }
  const std::vector<Vector3> places = corners(face.shape);
  const auto corner = [&](std::size_t i) { return Corner{places[i], depth(places[i])}; };
  Points points;
  for (std::size_t i = 2; i < places.size(); ++i)
    add_wet_points(depth, {corner(0), corner(i - 1), corner(i)}, most_halvings, points);
  return points;
}

template <int D>
Eigen::VectorXd pressure_force(const ElementMesh& mesh, const MeshElement& face, const laws::WaterPressure& water) {
  const FaceDepth depth(mesh, face, water);
  const auto nodes = static_cast<Eigen::Index>(face.node_list().size());
  Eigen::VectorXd force = Eigen::VectorXd::Zero(nodes * D);
  for (const QuadraturePoint& place : wet_points(mesh, face, water)) {
    const FacePoint<D> point = face_point<D>(mesh, face, place);
    const Real pressure = water.pressure(depth.place(place.place));
    for (Eigen::Index a = 0; a < nodes; ++a) force.segment<D>(a * D) -= point.weight * pressure * point.values[a] * point.normal;
  }
  return force;
}

template <int D>
Eigen::MatrixXd added_mass(const ElementMesh& mesh, const MeshElement& face, const laws::WaterPressure& water, Real density,
                           Real water_depth, MassMatrix kind) {
  const auto nodes = static_cast<Eigen::Index>(face.node_list().size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(nodes * D, nodes * D);
  Real all = 0, on_diagonal = 0;
  for (const MovingPoint<D>& point : moving_points<D>(mesh, face, water, density, water_depth)) {
    const Eigen::Matrix<Real, D, D> across = point.face.normal * point.face.normal.transpose();
    const NodeValues& values = point.face.values;
    all += point.mass;
    on_diagonal += point.mass * values.squaredNorm();
    for (Eigen::Index a = 0; a < nodes; ++a)
      for (Eigen::Index b = 0; b < nodes; ++b)
        if (a == b || kind == MassMatrix::consistent)
          matrix.block<D, D>(a * D, b * D) += point.mass * (values[a] * values[b]) * across;
  }
  if (kind == MassMatrix::lumped && on_diagonal > 0) matrix *= all / on_diagonal;
  return matrix;
}

template Eigen::VectorXd pressure_force<2>(const ElementMesh&, const MeshElement&, const laws::WaterPressure&);
template Eigen::VectorXd pressure_force<3>(const ElementMesh&, const MeshElement&, const laws::WaterPressure&);
template Eigen::MatrixXd added_mass<2>(const ElementMesh&, const MeshElement&, const laws::WaterPressure&, Real, Real,
                                       MassMatrix);
template Eigen::MatrixXd added_mass<3>(const ElementMesh&, const MeshElement&, const laws::WaterPressure&, Real, Real,
                                       MassMatrix);

}  // namespace sazare::methods::fem
