#include "sazare/methods/spheres/run/placing/lowering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sazare::runs {

namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();

}  // namespace

Lowering::Lowering(const cases::SpheresCase& spheres, const state::Spheres& placed)
    : down_(spheres.gravity.acceleration.normalized()), box_(placed.box) {
  for (const cases::WallRules& wall : spheres.walls) {
    if (wall.shape == cases::WallShape::plane) planes_.push_back({wall.point, wall.normal.normalized()});
    if (wall.shape != cases::WallShape::box) continue;
    for (int axis = 0; axis < 3; ++axis) {
      planes_.push_back({wall.lower, Vector3::Unit(axis)});
      planes_.push_back({wall.upper, -Vector3::Unit(axis)});
    }
  }
  for (const auto& place : placed.place) add({place.centre(), place.radius});
}

void Lowering::add(const geometry::Ball& ball) {
  const Real at = ball.centre.dot(down_);
  highest_ = all_.empty() ? at - ball.radius : std::min(highest_, at - ball.radius);
  lowest_ = all_.empty() ? at + ball.radius : std::max(lowest_, at + ball.radius);
  largest_ = std::max(largest_, ball.radius);
  all_.push_back({box_.wrapped(ball.centre), ball.radius});
  grid_.place(static_cast<Index>(all_.size() - 1), all_.back().centre, ball.radius);
}

std::optional<Real> Lowering::way_down(std::span<const geometry::Ball> balls) const {
  Real way = infinite;
  for (const geometry::Ball& ball : balls) way = std::min(way, way_to_planes(ball));
  for (const geometry::Ball& ball : balls) way = std::min(way, way_to_balls(ball, way));
  return way < infinite ? std::optional(way) : std::nullopt;
}

Real Lowering::way_to_planes(const geometry::Ball& ball) const {
  Real way = infinite;
  for (const Plane& plane : planes_)
    if (const Real approach = -plane.normal.dot(down_); approach > 1e-9)
      way = std::min(way, (plane.normal.dot(ball.centre - plane.point) - ball.radius) / approach);
  return way;
}

/// Looks from above all balls downwards, a piece of the way at a time, but not beyond `most`.
Real Lowering::way_to_balls(const geometry::Ball& ball, Real most) const {
  if (all_.empty()) return infinite;
  const Real piece = 2 * largest_, at = ball.centre.dot(down_);
  const Real end = std::min(most, lowest_ + ball.radius - at);
  Real way = infinite;
  for (Real from = highest_ - ball.radius - at; from < end && way > from; from += piece) {
    const Real middle = from + 0.5 * piece;
    const Vector3 centre = box_.wrapped(ball.centre + middle * down_);
    const auto images = [&](int axis) { return box_.length[axis] > 0 ? 1 : 0; };
    for (int x = -images(0); x <= images(0); ++x)
      for (int y = -images(1); y <= images(1); ++y)
        for (int z = -images(2); z <= images(2); ++z) {
          const Vector3 image = centre + box_.length.cwiseProduct(Vector3(x, y, z));
          grid_.visit_near(image, ball.radius + 0.5 * piece, [&](Index other) {
            way = std::min(way, way_to({image, ball.radius}, all_[static_cast<std::size_t>(other)], middle));
          });
        }
  }
  return way;
}

/// Until a ball touches another one, from where it has already gone so far.
Real Lowering::way_to(const geometry::Ball& ball, const geometry::Ball& other, Real from) const {
  const Vector3 apart = other.centre - ball.centre;
  const Real along = apart.dot(down_), reach = ball.radius + other.radius;
  const Real square = reach * reach - (apart.squaredNorm() - along * along);
  return square > 0 ? from + along - std::sqrt(square) : infinite;
}

}  // namespace sazare::runs
