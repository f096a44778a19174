#include "sazare/geometry/plane/polygon.hpp"

namespace sazare::geometry {

namespace {

Real cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

PolygonMeasures measure(std::span<const Vector2> corners) {
  PolygonMeasures result;
  if (corners.size() < 3) return result;
  const Vector2 from = corners.front();  // small numbers keep the round-off small
  Vector2 first = Vector2::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vector2 a = corners[i] - from, b = corners[i + 1] - from;
    const Real twice = cross(a, b);
    result.area += twice / 2;
    first += twice / 6 * (a + b);
    result.second_moment += twice / 12 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
  }
  const Vector2 centroid = first / result.area;
  result.second_moment -= result.area * centroid.squaredNorm();
  result.centroid = from + centroid;
  return result;
}

bool is_convex(std::span<const Vector2> corners) {
  const std::size_t n = corners.size();
  Real turned = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2 in = corners[(i + 1) % n] - corners[i], out = corners[(i + 2) % n] - corners[(i + 1) % n];
    const Real sine = cross(in, out);
    if (sine < -1e-9 * in.norm() * out.norm()) return false;
    turned += std::atan2(sine, in.dot(out));
  }
  return n >= 3 && turned < 7;  // once round, not twice as a star
}

bool holds(std::span<const Vector2> convex, const Vector2& point, Real margin) {
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vector2 way = convex[(i + 1) % convex.size()] - convex[i];
    if (cross(way, point - convex[i]) < margin * way.norm()) return false;
  }
  return true;
}

}  // namespace sazare::geometry
