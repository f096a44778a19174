#include "sazare/geometry/facets/points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace sazare::geometry {
namespace {

/// A sphere of radius 1 and a surface, in contact by linear springs of stiffness 1.
struct Contact {
  std::vector<Triangle> triangles;
  std::vector<PlaneInSpace> planes = {};
  FacetComplex complex{triangles, 1e-6, planes};

  std::vector<FacetPoint> points(const Vector3& centre) const {
    std::vector<NearFacet> near;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const TrianglePoint point = nearest_on(triangles[t], centre);
      const Real distance = (point.place - centre).norm();
      if (distance < 1 && complex.facets()[t].count > 0) near.push_back({static_cast<Index>(t), point, distance});
    }
    if (near.empty()) return {};
    FacetPoints found;
    found.find(
        complex, [&](Index vertex) { return complex.vertices()[static_cast<std::size_t>(vertex)].place; }, centre, 1, 1, near);
    return {found.points().begin(), found.points().end()};
  }
  Real energy(const Vector3& centre) const {
    Real sum = 0;
    for (const FacetPoint& point : points(centre)) sum += point.count * 0.5 * (1 - point.distance) * (1 - point.distance);
    return sum;
  }
  Vector3 force(const Vector3& centre) const {
    Vector3 sum = Vector3::Zero();
    for (const FacetPoint& point : points(centre)) {
      const Real overlap = 1 - point.distance;
      sum += point.count * overlap * point.normal - 0.5 * overlap * overlap * point.slope;
    }
    return sum;
  }
};

Real random(std::uint64_t& state) {
  state = state * 6364136223846793005ULL + 1442695040888963407ULL;
  return static_cast<Real>(state >> 11) / 9007199254740992.0;
}

using Height = std::function<Real(Real x, Real y)>;

/// A surface z(x, y) over a square of side 2 `half`, its nodes put off by up to a share of their distance.
std::vector<Triangle> surface(const Height& height, Real half, int cells, Real put_off = 0.3) {
  std::uint64_t state = 17;
  std::vector<std::vector<Vector3>> nodes;
  for (int i = 0; i <= cells; ++i) {
    nodes.emplace_back();
    for (int j = 0; j <= cells; ++j) {
      const bool inside = i > 0 && j > 0 && i < cells && j < cells;
      const Real way = inside ? 2 * half / cells * put_off : 0;
      const Real x = -half + 2 * half * i / cells + way * (2 * random(state) - 1),
                 y = -half + 2 * half * j / cells + way * (2 * random(state) - 1);
      nodes.back().emplace_back(x, y, height(x, y));
    }
  }
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    for (std::size_t j = 0; j + 1 < nodes.size(); ++j) {
      triangles.push_back({nodes[i][j], nodes[i + 1][j], nodes[i + 1][j + 1]});
      triangles.push_back({nodes[i][j], nodes[i + 1][j + 1], nodes[i][j + 1]});
    }
  return triangles;
}

/// Two halves of a square that meet in the y axis and rise from it by an angle in all, below 0 falling from it.
std::vector<Triangle> crease(Real angle, Real half = 3) {
  const Real x = half * std::cos(0.5 * angle), z = half * std::sin(0.5 * angle);
  const Vector3 low(0, -half, 0), high(0, half, 0);
  return {{low, Vector3(x, -half, z), Vector3(x, half, z)},
          {low, Vector3(x, half, z), high},
          {low, high, Vector3(-x, half, z)},
          {low, Vector3(-x, half, z), Vector3(-x, -half, z)}};
}

std::vector<Triangle> turned(std::vector<Triangle> triangles, const Matrix3& turn) {
  for (Triangle& triangle : triangles)
    for (Vector3& corner : triangle) corner = turn * corner;
  return triangles;
}

/// A ring of an inner and an outer radius that rises outwards by a slope, of so many pieces, cut across too.
std::vector<Triangle> funnel(Real inner, Real outer, Real slope, int pieces, int rings) {
  const auto node = [&](int ring, int piece) {
    const Real r = inner + (outer - inner) * ring / rings, a = 2 * std::numbers::pi * (piece % pieces) / pieces;
    return Vector3(r * std::cos(a), r * std::sin(a), slope * (r - inner));
  };
  std::vector<Triangle> triangles;
  for (int ring = 0; ring < rings; ++ring)
    for (int piece = 0; piece < pieces; ++piece) {
      triangles.push_back({node(ring, piece), node(ring + 1, piece), node(ring + 1, piece + 1)});
      triangles.push_back({node(ring, piece), node(ring + 1, piece + 1), node(ring, piece + 1)});
    }
  return triangles;
}

/// The largest difference between the force and the energy's derivative at places within a box, over the largest force there.
/// Where the force bends, the difference is of the order of the step.
Real largest_error(const Contact& contact, const Vector3& lower, const Vector3& upper, int places = 1000) {
  constexpr Real step = 1e-6;
  std::uint64_t state = 5;
  Real largest = 0, error = 0;
  for (int n = 0; n < places; ++n) {
    const Vector3 part(random(state), random(state), random(state)), centre = lower + part.cwiseProduct(upper - lower);
    const Vector3 force = contact.force(centre);
    largest = std::max(largest, force.norm());
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 way = step * Vector3::Unit(axis);
      const Real slope = (contact.energy(centre + way) - contact.energy(centre - way)) / (2 * step);
      error = std::max(error, std::abs(slope + force[axis]));
    }
  }
  EXPECT_GT(largest, 0);
  return error / largest;
}

/// The largest jump of the force along straight ways, over the step on them and the stiffness.
Real steepest(const Contact& contact, const Vector3& from, const Vector3& to) {
  constexpr int steps = 20000;
  Real steepest = 0;
  Vector3 before = contact.force(from);
  for (int n = 1; n <= steps; ++n) {
    const Vector3 force = contact.force(from + static_cast<Real>(n) / steps * (to - from));
    steepest = std::max(steepest, (force - before).norm() / ((to - from).norm() / steps));
    before = force;
  }
  return steepest;
}

TEST(facet_points, a_flat_surface_counts_once_to_the_last_digit_however_it_is_cut) {
  for (const int cells : {2, 7, 60}) {
    const Contact contact{surface([](Real, Real) { return 0.0; }, 3, cells)};
    std::uint64_t state = 3;
    for (int n = 0; n < 500; ++n) {
      const Vector3 centre(2 * random(state) - 1, 2 * random(state) - 1, 1 - 0.05 * random(state));
      const auto points = contact.points(centre);
      ASSERT_EQ(points.size(), 1);
      EXPECT_EQ(points.front().count, 1);
      EXPECT_EQ(points.front().share, 1);
      EXPECT_NEAR(points.front().distance, centre.z(), 1e-15);
    }
  }
}

TEST(facet_points, outer_edges_and_corners_count_once) {
  const Contact ridge{crease(-0.6)}, peak{surface([](Real x, Real y) { return -0.4 * std::hypot(x, y); }, 3, 20, 0)};
  std::uint64_t state = 3;
  for (int n = 0; n < 500; ++n) {
    const Vector3 centre(0.2 * random(state) - 0.1, random(state), 0.97 + 0.02 * random(state));
    Real sum = 0;
    for (const FacetPoint& point : ridge.points(centre)) sum += point.count;
    EXPECT_EQ(sum, 1);
  }
  const auto on_peak = peak.points({0, 0, 0.98});
  ASSERT_EQ(on_peak.size(), 1);
  EXPECT_EQ(on_peak.front().count, 1);
}

TEST(facet_points, both_sides_of_a_groove_count_as_long_as_the_sphere_does_not_reach_its_ground) {
  const Contact contact{crease(0.5 * std::numbers::pi)};
  const auto points = contact.points({0, 0, 0.99 * std::numbers::sqrt2});
  ASSERT_EQ(points.size(), 2);
  for (const FacetPoint& point : points) {
    EXPECT_EQ(point.count, 1);
    EXPECT_EQ(point.share, 1);
    EXPECT_NEAR(point.distance, 0.99, 1e-15);
  }
}

TEST(facet_points, forces_are_derivatives_of_an_energy) {
  const Matrix3 turn = Eigen::AngleAxis<Real>(0.4, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Real degrees : {0.1, 1.0, 5.0, 20.0, 60.0, 90.0})
    for (const Real sign : {-1.0, 1.0}) {
      const Contact contact{turned(crease(sign * degrees * std::numbers::pi / 180), turn)};
      EXPECT_LT(largest_error(contact, {-1, -1, 0.3}, {1, 1, 1.2}), 1e-5) << degrees;
    }
  for (const int cells : {3, 10, 40}) {
    const Height waves = [](Real x, Real y) { return 0.15 * std::sin(3 * x) * std::cos(2 * y); },
                 saddle = [](Real x, Real y) { return 0.3 * (x * x - y * y); },
                 bowl = [](Real x, Real y) { return 0.3 * (x * x + y * y); };
    for (const Height& height : {waves, saddle, bowl})
      EXPECT_LT(largest_error({surface(height, 2, cells)}, {-1, -1, 0.7}, {1, 1, 1.3}, 900 / cells), 1e-5) << cells;
  }
  EXPECT_LT(largest_error({funnel(0.3, 2, 1, 12, 3)}, {-0.3, -0.3, 0.9}, {0.3, 0.3, 1.3}), 1e-5);
  EXPECT_LT(largest_error({funnel(0.5, 2, 0, 9, 2)}, {-0.6, -0.6, 0.7}, {0.6, 0.6, 1}), 1e-5) << "a hole";
}

TEST(facet_points, forces_do_not_jump) {
  for (const Real angle : {0.002, 0.02, 0.1, 0.4, 1.0, 1.5})
    for (const Real distance : {0.9, 0.99, 0.999}) {
      const Real height = distance / std::cos(0.5 * angle);
      EXPECT_LT(steepest({crease(angle)}, {-0.5, 0.1, height}, {0.5, 0.13, height}), 4);
    }
  const Contact waves{surface([](Real x, Real y) { return 0.05 * std::sin(3 * x) * std::cos(2 * y); }, 2, 14)};
  EXPECT_LT(steepest(waves, {-1, -0.9, 0.99}, {1, 0.7, 0.98}), 6);
}

TEST(facet_points, a_ring_holds_a_sphere_however_fine_it_is) {
  for (const int pieces : {6, 24, 96})
    for (const int rings : {1, 8}) {
      const Contact steep{funnel(0.2, 2, 1, pieces, rings)}, hole{funnel(0.5, 2, 0, pieces, rings)};
      const Real touching = std::numbers::sqrt2 - 0.2, on_rim = std::sqrt(0.75);  // heights of the centre
      for (const Real overlap : {0.001, 0.01, 0.03}) {
        EXPECT_GT(steep.force({0, 0, touching - overlap * std::numbers::sqrt2}).z(), overlap) << pieces << " " << rings;
        const Vector3 on_hole = hole.force({0, 0, on_rim - overlap});
        EXPECT_GT(on_hole.z(), 0.5 * overlap) << pieces << " " << rings;
        EXPECT_LT(std::hypot(on_hole.x(), on_hole.y()), 1e-12);
      }
    }
}

TEST(facet_points, sides_that_lie_on_longer_ones_and_facets_that_are_there_twice_count_once) {
  const Vector3 a(-3, 0, 0), b(3, 0, 0), low(0, -3, 0), high(0, 3, 0), on(0.7, 0, 0), also(-1.1, 0, 0);
  std::vector<Triangle> triangles = {{low, b, a}, {high, a, also}, {high, also, on}, {high, on, b}};
  triangles.push_back(triangles[1]);
  const Contact contact{triangles};
  std::uint64_t state = 3;
  for (int n = 0; n < 500; ++n) {
    const auto points = contact.points({2 * random(state) - 1, 0.2 * random(state) - 0.1, 0.98});
    ASSERT_EQ(points.size(), 1);
    EXPECT_EQ(points.front().count, 1);
  }
}

TEST(facet_points, what_lies_in_a_plane_counts_there) {
  const PlaneInSpace floor{Vector3::Zero(), Vector3::UnitZ()};
  std::vector<Triangle> ramp = crease(0.1);
  for (Triangle& triangle : ramp)
    for (Vector3& corner : triangle) corner = Eigen::AngleAxis<Real>(0.05, Vector3::UnitY()) * corner;  // one side is level
  const Contact contact{ramp, {floor}};
  EXPECT_TRUE(contact.points({1.5, 0, 0.98}).empty());
  const Contact alone{ramp};
  for (const Real x : {0.0, 0.005, 0.02, 0.05, 0.1}) {
    const Vector3 centre(x, 0.1, 0.98);
    EXPECT_LT((contact.force(centre) + Vector3(0, 0, 0.02) - alone.force(centre)).norm(), 0.07 * 0.02) << x;
  }
}

}  // namespace
}  // namespace sazare::geometry
