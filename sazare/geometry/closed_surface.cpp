#include "sazare/geometry/closed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace sazare::geometry {

namespace {

using Edge = std::pair<Vector3, Vector3>;

bool less(const Vector3& a, const Vector3& b) { return std::ranges::lexicographical_compare(a, b); }

/// An edge of a triangle, from its lesser corner to its greater one, and whether the triangle goes along it.
struct Side {
  Edge edge;
  bool along = true;
};

bool less(const Side& a, const Side& b) {
  return less(a.edge.first, b.edge.first) || (a.edge.first == b.edge.first && less(a.edge.second, b.edge.second));
}

std::vector<Side> sides_of(std::span<const Triangle> surface) {
  std::vector<Side> sides;
  sides.reserve(3 * surface.size());
  for (const Triangle& triangle : surface)
    for (std::size_t n = 0; n < 3; ++n) {
      const Vector3 &from = triangle[n], &to = triangle[(n + 1) % 3];
      const bool along = less(from, to);
      sides.push_back({along ? Edge(from, to) : Edge(to, from), along});
    }
  std::ranges::sort(sides, [](const Side& a, const Side& b) { return less(a, b); });
  return sides;
}

}  // namespace

SurfaceEdges edges_of(std::span<const Triangle> surface) {
  const std::vector<Side> sides = sides_of(surface);
  SurfaceEdges edges;
  for (auto from = sides.begin(); from != sides.end();) {
    const auto to = std::find_if(from, sides.end(), [&](const Side& side) { return side.edge != from->edge; });
    const std::ptrdiff_t triangles = to - from;
    edges.open += triangles == 1 ? 1 : 0;
    edges.crowded += triangles > 2 ? 1 : 0;
    edges.turned += triangles == 2 && from->along == std::next(from)->along ? 1 : 0;
    from = to;
  }
  return edges;
}

UnionProperties properties_of_solid(std::span<const Triangle> surface) {
  const Vector3 origin = surface.front().front();  // near the solid, so that sums lose no digits
  Real volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();  // integral of x x^T
  for (const Triangle& triangle : surface) {
    const Vector3 a = triangle[0] - origin, b = triangle[1] - origin, c = triangle[2] - origin, sum = a + b + c;
    const Real own = a.dot(b.cross(c)) / 6;
    volume += own;
    first += own / 4 * sum;
    second += own / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  UnionProperties of;
  const Vector3 centre = first / volume;
  const Matrix3 central = (volume < 0 ? -1 : 1) * (second - volume * centre * centre.transpose());
  of.volume = std::abs(volume);
  of.centre = origin + centre;
  of.inertia = central.trace() * Matrix3::Identity() - central;
  return of;
}

}  // namespace sazare::geometry
