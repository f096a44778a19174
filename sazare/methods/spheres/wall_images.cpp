#include "sazare/methods/spheres/wall_images.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sazare::methods::spheres {

namespace {

constexpr Real rounding = 1e-9;

struct Range {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;

  void include(Real low_too, Real high_too) {
    low = std::min(low, low_too);
    high = std::max(high, high_too);
  }
};

Range range_of(const geometry::Triangle& corners, int axis) {
  Range range;
  for (const Vector3& corner : corners) range.include(corner[axis], corner[axis]);
  return range;
}

Range range_of(const Wall& wall, int axis) {
  Range range;
  for (const geometry::Triangle& triangle : wall.triangles)
    for (const Vector3& corner : triangle) range.include(corner[axis], corner[axis]);
  return range;
}

/// Through which it goes when it turns.
Range swept_range(const Wall& wall, int axis) {
  const Vector3 about = wall.motion.spin.normalized();
  Range range;
  for (const geometry::Triangle& triangle : wall.triangles)
    for (const Vector3& corner : triangle) {
      const Vector3 arm = corner - wall.motion.pivot, along = arm.dot(about) * about;
      const Real middle = wall.motion.pivot[axis] + along[axis],
                 way = (arm - along).norm() * std::sqrt(std::max(1 - about[axis] * about[axis], Real{0}));
      range.include(middle - way, middle + way);
    }
  return range;
}

bool turns_across(const WallMotion& motion, int axis) {
  return motion.spin.norm() > 0 && motion.spin.cross(Vector3::Unit(axis)).norm() > rounding * motion.spin.norm();
}

/// Whether a surface that turns, or moves, comes to a side of the domain across an axis.
bool comes_to_a_side(const Wall& wall, const state::PeriodicBox& box, int axis, Real reach) {
  if (std::ranges::any_of(wall.motion.histories, [&](const auto& history) { return history.first == axis; })) return true;
  const Range swept = swept_range(wall, axis);
  return swept.low < box.lower[axis] + reach || swept.high > box.lower[axis] + box.length[axis] - reach;
}

/// Adds the next images of triangles along an axis, as far as they come within the reach of the domain: those after them would
/// lie where a longer surface is already. Returns whether there are any.
bool add_images(std::vector<geometry::Triangle>& triangles, const state::PeriodicBox& box, int axis, Real reach) {
  const Real length = box.length[axis], low = box.lower[axis] - reach, high = box.lower[axis] + length + reach;
  const std::size_t count = triangles.size();
  for (std::size_t n = 0; n < count; ++n) {
    const Range range = range_of(triangles[n], axis);
    for (const Real way : {-length, length}) {
      if (range.high + way < low || range.low + way > high) continue;
      geometry::Triangle moved = triangles[n];
      for (Vector3& corner : moved) corner[axis] += way;
      triangles.push_back(moved);
    }
  }
  return triangles.size() > count;
}

}  // namespace

WallSides sides_of(const Wall& wall, const state::PeriodicBox& box, int axis, Real reach) {
  WallSides sides;
  if (wall.triangles.empty() || box.length[axis] <= 0) return sides;
  const Range range = range_of(wall, axis);
  const Real low = box.lower[axis] - reach, high = box.lower[axis] + box.length[axis] + reach,
             allowed = rounding * box.length[axis];
  sides.gap = box.length[axis] - (range.high - range.low);
  sides.repeats = range.low > low + allowed || range.high < high - allowed;
  sides.can = !sides.repeats || !turns_across(wall.motion, axis) || !comes_to_a_side(wall, box, axis, reach);
  return sides;
}

std::array<bool, 3> repeat_wall(Wall& wall, const state::PeriodicBox& box, Real reach) {
  state::PeriodicBox images;
  for (int axis = 0; axis < 3; ++axis)
    if (sides_of(wall, box, axis, reach).repeats && !turns_across(wall.motion, axis)) {
      images.lower[axis] = box.lower[axis];
      images.length[axis] = box.length[axis];
    }
  wall.images = images;
  std::array<bool, 3> has{};
  for (int axis = 0; axis < 3; ++axis)
    if (images.length[axis] > 0) has[static_cast<std::size_t>(axis)] = add_images(wall.triangles, images, axis, reach);
  return has;
}

}  // namespace sazare::methods::spheres
