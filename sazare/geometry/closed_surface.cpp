#include "sazare/geometry/closed_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sazare::geometry {

namespace {

using Edge = std::pair<Vector3, Vector3>;

bool less(const Vector3& a, const Vector3& b) { return std::ranges::lexicographical_compare(a, b); }

struct EdgeLess {
  bool operator()(const Edge& a, const Edge& b) const {
    return less(a.first, b.first) || (!less(b.first, a.first) && less(a.second, b.second));
  }
};

/// How many triangles go along an edge, and against it.
struct Uses {
  std::size_t along = 0, against = 0;
};

}  // namespace

SurfaceEdges edges_of(std::span<const Triangle> surface) {
  std::map<Edge, Uses, EdgeLess> uses;
  for (const Triangle& triangle : surface)
    for (std::size_t n = 0; n < 3; ++n) {
      const Vector3 &from = triangle[n], &to = triangle[(n + 1) % 3];
      if (less(from, to))
        ++uses[{from, to}].along;
      else
        ++uses[{to, from}].against;
    }
  SurfaceEdges edges;
  for (const auto& [edge, of] : uses) {
    const std::size_t triangles = of.along + of.against;
    edges.open += triangles == 1 ? 1 : 0;
    edges.crowded += triangles > 2 ? 1 : 0;
    edges.turned += triangles == 2 && of.along != of.against ? 1 : 0;
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
