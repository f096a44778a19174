#pragma once

/// Triangles in a tree of boxes, for questions which of them are near a place: memory and time by their number, whatever their
/// size.

#include <cstdint>
#include <span>
#include <vector>

#include "sazare/geometry/triangle.hpp"

namespace sazare::geometry {

struct TriangleBox {
  Vector3 lower, upper;

  bool meets(const TriangleBox& other) const {
    return (lower.array() <= other.upper.array()).all() && (other.lower.array() <= upper.array()).all();
  }
};

TriangleBox box_of(const Triangle& corners);

class TriangleTree {
public:
  /// `reach` is the largest distance that is asked for [m], >= 0.
  TriangleTree(std::span<const Triangle> triangles, Real reach);

  /// All triangles within the reach of a place, and some beyond; in the order of the file.
  std::vector<std::int32_t> near(const Vector3& place) const { return meeting({place, place}); }

  /// All triangles whose boxes come within the reach of a box, in the order of the file.
  std::vector<std::int32_t> meeting(const TriangleBox& box) const;

private:
  /// The box around some triangles: those of a leaf, or of the two nodes below.
  struct Node {
    TriangleBox box;
    std::int32_t first = 0;  ///< of `order_` for a leaf, else the node that holds the upper half; the lower half follows at once
    std::int32_t count = 0;  ///< 0 where two nodes are below
  };

  std::int32_t build(std::span<const TriangleBox> boxes, std::int32_t first, std::int32_t count);

  std::vector<Node> nodes_;
  std::vector<TriangleBox> boxes_;   ///< of the triangles in the order of the leaves, widened by the reach
  std::vector<std::int32_t> order_;  ///< numbers of the triangles by leaf
};

}  // namespace sazare::geometry
