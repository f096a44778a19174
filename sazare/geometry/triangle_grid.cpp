#include "sazare/geometry/triangle_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sazare::geometry {

namespace {

constexpr Real most_cells = 1e6;  // in the box around all triangles
constexpr int bits = 21;

struct Box {
  Vector3 lower = Vector3::Constant(std::numeric_limits<Real>::infinity());
  Vector3 upper = -lower;

  void include(const Triangle& corners) {
    for (const Vector3& corner : corners) {
      lower = lower.cwiseMin(corner);
      upper = upper.cwiseMax(corner);
    }
  }
};

std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
  return static_cast<std::uint64_t>(x) | static_cast<std::uint64_t>(y) << bits | static_cast<std::uint64_t>(z) << 2 * bits;
}

}  // namespace

TriangleGrid::TriangleGrid(std::span<const Triangle> triangles, Real reach) {
  Box all;
  for (const Triangle& triangle : triangles) all.include(triangle);
  if (triangles.empty()) all.lower = all.upper = Vector3::Zero();
  lower_ = all.lower.array() - reach;
  const Vector3 size = (all.upper - all.lower).array() + 2 * reach;
  width_ = std::max(2 * reach, std::cbrt(size.prod() / most_cells));
  const Real meets = reach + std::sqrt(Real{0.75}) * width_;  // from the middle of a cell
  for (std::size_t number = 0; number < triangles.size(); ++number) {
    Box box;
    box.include(triangles[number]);
    const Vector3 from = ((box.lower - lower_).array() - reach) / width_, to = ((box.upper - lower_).array() + reach) / width_;
    for (auto x = static_cast<std::int64_t>(from.x()); x <= static_cast<std::int64_t>(to.x()); ++x)
      for (auto y = static_cast<std::int64_t>(from.y()); y <= static_cast<std::int64_t>(to.y()); ++y)
        for (auto z = static_cast<std::int64_t>(from.z()); z <= static_cast<std::int64_t>(to.z()); ++z) {
          const Vector3 middle =
              lower_ +
              width_ * (Vector3(static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z)).array() + 0.5).matrix();
          if ((nearest_point(triangles[number], middle) - middle).norm() <= meets)
            cells_[key(x, y, z)].push_back(static_cast<std::int32_t>(number));
        }
  }
}

TriangleGrid::Key TriangleGrid::key_of(const Vector3& place) const {
  const Vector3 at = (place - lower_) / width_;
  if (!(at.minCoeff() >= 0) || !(at.maxCoeff() < 1 << bits)) return ~Key{0};
  return key(static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()), static_cast<std::int64_t>(at.z()));
}

std::span<const std::int32_t> TriangleGrid::near(const Vector3& place) const {
  const auto found = cells_.find(key_of(place));
  return found == cells_.end() ? std::span<const std::int32_t>{} : std::span<const std::int32_t>(found->second);
}

}  // namespace sazare::geometry
