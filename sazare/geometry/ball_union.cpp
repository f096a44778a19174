#include "sazare/geometry/ball_union.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace sazare::geometry {

namespace {

/// Moments of a body of density 1 about the origin.
struct Moments {
  Real volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();  ///< integral of x x^T

  /// Adds a piece of a line parallel to z, of a cross-section.
  void add(Real x, Real y, Real low, Real high, Real area) {
    const Real length = high - low, z = 0.5 * (high * high - low * low), zz = (high * high * high - low * low * low) / 3;
    volume += area * length;
    first += area * Vector3(x * length, y * length, z);
    Matrix3 piece;
    piece << x * x * length, x * y * length, x * z, x * y * length, y * y * length, y * z, x * z, y * z, zz;
    second += area * piece;
  }

  UnionProperties properties() const {
    UnionProperties of;
    of.volume = volume;
    of.centre = first / volume;
    const Matrix3 central = second - volume * of.centre * of.centre.transpose();
    of.inertia = central.trace() * Matrix3::Identity() - central;
    return of;
  }
};

struct Box {
  Vector3 lower = Vector3::Constant(std::numeric_limits<Real>::infinity());
  Vector3 upper = -lower;

  void add(const Vector3& point, Real reach = 0) {
    lower = lower.cwiseMin(point - Vector3::Constant(reach));
    upper = upper.cwiseMax(point + Vector3::Constant(reach));
  }
};

Moments moments(std::span<const Ball> balls, int lines) {
  Box box;
  for (const Ball& ball : balls) box.add(ball.centre, ball.radius);
  const Real width = std::max(box.upper.x() - box.lower.x(), box.upper.y() - box.lower.y()) / lines;
  Moments sum;
  std::vector<std::pair<Real, Real>> pieces;
  for (Real x = box.lower.x() + 0.5 * width; x < box.upper.x(); x += width)
    for (Real y = box.lower.y() + 0.5 * width; y < box.upper.y(); y += width) {
      pieces.clear();
      for (const Ball& ball : balls) {
        const Real dx = x - ball.centre.x(), dy = y - ball.centre.y(), square = ball.radius * ball.radius - dx * dx - dy * dy;
        if (square > 0) pieces.emplace_back(ball.centre.z() - std::sqrt(square), ball.centre.z() + std::sqrt(square));
      }
      std::ranges::sort(pieces);
      for (std::size_t n = 0; n < pieces.size();) {
        const Real low = pieces[n].first;
        Real high = pieces[n].second;
        for (++n; n < pieces.size() && pieces[n].first <= high; ++n) high = std::max(high, pieces[n].second);
        sum.add(x, y, low, high, width * width);
      }
    }
  return sum;
}

/// Solid angle of a triangle seen from a point, over that of the sphere (van Oosterom and Strackee).
Real solid_angle(const Triangle& corners, const Vector3& point) {
  const Vector3 a = corners[0] - point, b = corners[1] - point, c = corners[2] - point;
  const Real na = a.norm(), nb = b.norm(), nc = c.norm();
  return std::atan2(a.dot(b.cross(c)), na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb) / (2 * std::numbers::pi);
}

/// Distance of a point from a surface; 0 outside of it.
Real depth(std::span<const Triangle> surface, const Vector3& point) {
  Real angle = 0, nearest = std::numeric_limits<Real>::infinity();
  for (const Triangle& triangle : surface) {
    angle += solid_angle(triangle, point);
    nearest = std::min(nearest, (nearest_point(triangle, point) - point).squaredNorm());
  }
  return std::abs(angle) > 0.5 ? std::sqrt(nearest) : 0;
}

}  // namespace

UnionProperties properties_of_union(std::span<const Ball> balls, int lines) {
  const UnionProperties coarse = moments(balls, lines / 2).properties();
  UnionProperties fine = moments(balls, lines).properties();
  fine.error =
      std::max(std::abs(fine.volume - coarse.volume) / fine.volume, (fine.inertia - coarse.inertia).norm() / fine.inertia.norm());
  return fine;
}

std::vector<Ball> tetrapod_balls(Real height, int per_leg) {
  const Real length = 0.644 * height, at_centre = 0.265 * height, at_end = 0.151 * height;
  const Real slope = (at_centre - at_end) / length, shrink = 1 / std::sqrt(1 + slope * slope);
  const auto fitting = [&](Real at) { return shrink * (at_centre - slope * at); };
  // The outermost ball touches both the cone and its end: at + fitting(at) = length.
  const Real last = (length - shrink * at_centre) / (1 - shrink * slope), side = std::sqrt(8.0) / 3;
  const std::array<Vector3, 4> legs{Vector3(0, 0, 1), Vector3(side, 0, -1.0 / 3),
                                    Vector3(-0.5 * side, std::sqrt(2.0 / 3), -1.0 / 3),
                                    Vector3(-0.5 * side, -std::sqrt(2.0 / 3), -1.0 / 3)};
  std::vector<Ball> balls{{Vector3::Zero(), fitting(0)}};
  for (const Vector3& leg : legs)
    for (int n = 1; n <= per_leg; ++n) {
      const Real at = last * n / per_leg;
      balls.push_back({at * leg, fitting(at)});
    }
  return balls;
}

std::vector<Ball> fill_with_balls(std::span<const Triangle> surface, int count, int cells) {
  Box box;
  for (const Triangle& triangle : surface)
    for (const Vector3& corner : triangle) box.add(corner);
  const Real width = (box.upper - box.lower).maxCoeff() / cells;
  std::vector<Ball> fits;  // the largest ball at each place of the grid
  for (Real x = box.lower.x() + 0.5 * width; x < box.upper.x(); x += width)
    for (Real y = box.lower.y() + 0.5 * width; y < box.upper.y(); y += width)
      for (Real z = box.lower.z() + 0.5 * width; z < box.upper.z(); z += width)
        if (const Real radius = depth(surface, {x, y, z}); radius > 0.5 * width) fits.push_back({{x, y, z}, radius});
  std::ranges::stable_sort(fits, std::ranges::greater{}, &Ball::radius);
  std::vector<Ball> chosen;
  for (const Ball& ball : fits) {
    if (static_cast<int>(chosen.size()) == count) break;
    const bool filled =
        std::ranges::any_of(chosen, [&](const Ball& other) { return (other.centre - ball.centre).norm() < other.radius; });
    if (!filled) chosen.push_back(ball);
  }
  return chosen;
}

}  // namespace sazare::geometry
