#pragma once

/// What the points of a body that touch a surface remember from one evaluation to the next.
///
/// A `Point` has the members
///
///     Index is_touching      whether it has been found in this evaluation
///     Vector3 normal         of the contact, which may point either way, always the same
///     memory                 of a contact law, whose plane turns with turn(normal, tilt, angle)

#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::geometry {

/// The point that faced most nearly the way of `normal` among those of which `is_of_same(point)` is true; else a new one, which
/// begins with what the one beside it remembers, since it takes over from it. Several points of a body lie farther apart than
/// `same_direction`, a cosine.
template <class Point, class IsOfSame>
Point& touching_point(std::vector<Point>& points, const Vector3& normal, IsOfSame&& is_of_same) {
  constexpr Real same_direction = 0.7;
  const auto like = [&](bool again) {
    auto best = points.end();
    Real most = same_direction;
    for (auto known = points.begin(); known != points.end(); ++known) {
      if (!is_of_same(*known) || (known->is_touching != 0 && !again)) continue;
      const Real along = known->normal.dot(normal);
      if (!(along > most)) continue;
      most = along;
      best = known;
    }
    return best;
  };
  auto point = like(false);
  if (point == points.end()) {
    const auto beside = like(true);
    Point added;
    added.normal = normal;
    if (beside != points.end()) added.memory = beside->memory;
    point = points.insert(points.end(), added);
  }
  point->is_touching = 1;
  return *point;
}

/// The plane of contact turns: `angle` about its normal since the last evaluation [rad].
template <class Point>
void turn_point(Point& point, const Vector3& normal, Real angle) {
  const Vector3 tilt = 2 / (1 + point.normal.dot(normal)) * (normal - point.normal);  // exact for any angle
  point.memory.turn(normal, tilt, angle);
  point.normal = normal;
}

}  // namespace sazare::geometry
