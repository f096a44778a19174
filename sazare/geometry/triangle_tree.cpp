#include "sazare/geometry/triangle_tree.hpp"

#include <algorithm>
#include <numeric>

namespace sazare::geometry {

namespace {

constexpr std::int32_t most_in_leaf = 4;
constexpr std::size_t deepest = 64;  // halves of at most 2^31 triangles

void include(TriangleBox& box, const TriangleBox& other) {
  box.lower = box.lower.cwiseMin(other.lower);
  box.upper = box.upper.cwiseMax(other.upper);
}

}  // namespace

TriangleBox box_of(const Triangle& corners) {
  return {corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]), corners[0].cwiseMax(corners[1]).cwiseMax(corners[2])};
}

TriangleTree::TriangleTree(std::span<const Triangle> triangles, Real reach) : order_(triangles.size()) {
  std::vector<TriangleBox> boxes;
  boxes.reserve(triangles.size());
  for (const Triangle& triangle : triangles) {
    const TriangleBox box = box_of(triangle);
    boxes.push_back({box.lower.array() - reach, box.upper.array() + reach});
  }
  std::iota(order_.begin(), order_.end(), 0);
  if (!triangles.empty()) build(boxes, 0, static_cast<std::int32_t>(triangles.size()));
  boxes_.reserve(boxes.size());
  for (const std::int32_t number : order_) boxes_.push_back(boxes[static_cast<std::size_t>(number)]);
}

/// Halves the triangles along the longest side of the box of their middles.
std::int32_t TriangleTree::build(std::span<const TriangleBox> boxes, std::int32_t first, std::int32_t count) {
  const auto at = static_cast<std::int32_t>(nodes_.size());
  const auto begin = order_.begin() + first, end = begin + count;
  const auto box_at = [&](std::int32_t number) -> const TriangleBox& { return boxes[static_cast<std::size_t>(number)]; };
  Node node{box_at(*begin), first, count};
  Vector3 middle = box_at(*begin).lower + box_at(*begin).upper;  // twice the middle
  TriangleBox middles{middle, middle};
  for (auto one = begin; one != end; ++one) {
    include(node.box, box_at(*one));
    middle = box_at(*one).lower + box_at(*one).upper;
    include(middles, {middle, middle});
  }
  nodes_.push_back(node);
  if (count <= most_in_leaf) return at;
  Eigen::Index axis = 0;
  (middles.upper - middles.lower).maxCoeff(&axis);
  const std::int32_t half = count / 2;
  std::nth_element(begin, begin + half, end, [&](std::int32_t a, std::int32_t b) {
    const Real of_a = box_at(a).lower[axis] + box_at(a).upper[axis], of_b = box_at(b).lower[axis] + box_at(b).upper[axis];
    return of_a < of_b || (of_a == of_b && a < b);
  });
  build(boxes, first, half);
  const std::int32_t upper = build(boxes, first + half, count - half);
  nodes_[static_cast<std::size_t>(at)].first = upper;
  nodes_[static_cast<std::size_t>(at)].count = 0;
  return at;
}

std::vector<std::int32_t> TriangleTree::meeting(const TriangleBox& box) const {
  std::vector<std::int32_t> found;
  if (nodes_.empty()) return found;
  std::array<std::int32_t, deepest> waiting{};
  std::size_t depth = 1;
  while (depth > 0) {
    const std::int32_t at = waiting[--depth];
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    if (!node.box.meets(box)) continue;
    if (node.count == 0) {
      waiting[depth++] = node.first;
      waiting[depth++] = at + 1;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i)
      if (boxes_[static_cast<std::size_t>(i)].meets(box)) found.push_back(order_[static_cast<std::size_t>(i)]);
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace sazare::geometry
