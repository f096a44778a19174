#pragma once

/// Triangles by cells, for questions which of them are near a place.

#include <cstdint>
#include <span>
#include <unordered_map>

#include "sazare/geometry/triangle.hpp"

namespace sazare::geometry {

class TriangleGrid {
public:
  /// `reach` is the largest distance that is asked for [m], > 0.
  TriangleGrid(std::span<const Triangle> triangles, Real reach);

  /// All triangles within the reach of a place, and some beyond; in the order of the file.
  std::span<const std::int32_t> near(const Vector3& place) const;

private:
  using Key = std::uint64_t;
  Key key_of(const Vector3& place) const;

  Vector3 lower_;
  Real width_ = 1;
  std::unordered_map<Key, std::vector<std::int32_t>> cells_;
};

}  // namespace sazare::geometry
