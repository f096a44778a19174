#include "sazare/geometry/shells.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "cube.hpp"

namespace sazare::geometry {
namespace {

using Kind = ShellFault::Kind;

struct Part {
  Vector3 corner, size;
  bool turned = false;
};

/// Boxes in one surface.
std::vector<Triangle> boxes(const std::vector<Part>& parts) {
  std::vector<Triangle> surface;
  for (const Part& part : parts)
    for (Triangle triangle : cube(1)) {
      for (Vector3& corner : triangle) corner = part.corner + part.size.cwiseProduct(corner);
      if (part.turned) std::swap(triangle[1], triangle[2]);
      surface.push_back(triangle);
    }
  return surface;
}

std::optional<Kind> fault(const std::vector<Part>& parts) {
  const auto found = find_shell_fault(boxes(parts));
  return found ? std::optional(found->kind) : std::nullopt;
}

const Vector3 one = Vector3::Ones();

TEST(shells, may_stand_apart_or_touch_from_outside) {
  EXPECT_FALSE(fault({{Vector3::Zero(), one}}));
  EXPECT_FALSE(fault({{Vector3::Zero(), one, true}})) << "either side may be out";
  EXPECT_FALSE(fault({{Vector3::Zero(), one}, {{3, 0, 0}, one}}));
  EXPECT_FALSE(fault({{Vector3::Zero(), one}, {{1, 0.3, 0.2}, one}}));
  EXPECT_FALSE(fault({{Vector3::Zero(), one}, {{1, 0.25, 0.25}, 0.5 * one}}));
}

TEST(shells, that_overlap_count_twice) {
  EXPECT_EQ(fault({{Vector3::Zero(), {0.2, 0.1, 0.1}}, {{0.1, 0, 0}, {0.2, 0.1, 0.1}}}), Kind::doubled) << "with common faces";
  EXPECT_EQ(fault({{Vector3::Zero(), one}, {{0.5, 0.3, 0.2}, one}}), Kind::crossing);
  EXPECT_EQ(fault({{Vector3::Zero(), one}, {{0.25, 0.25, 0.25}, 0.5 * one}}), Kind::doubled) << "a box within a box";
  EXPECT_EQ(fault({{Vector3::Zero(), one, true}, {{0.25, 0.25, 0.25}, 0.5 * one, true}}), Kind::doubled);
  EXPECT_EQ(fault({{Vector3::Zero(), one}, {{0.5, 0.25, 0.25}, 0.5 * one}}), Kind::doubled) << "touching from within";
  EXPECT_EQ(fault({{Vector3::Zero(), one}, {{0.4, -1, 0.4}, {0.2, 3, 0.2}}}), Kind::crossing) << "a bar through a box";
}

TEST(shells, of_hollows_are_turned) {
  const Part hollow{{0.25, 0.25, 0.25}, 0.5 * one, true};
  EXPECT_FALSE(fault({{Vector3::Zero(), one}, hollow}));
  EXPECT_FALSE(fault({{Vector3::Zero(), one}, hollow, {{0.4, 0.4, 0.4}, 0.2 * one}})) << "a solid within the hollow";
  EXPECT_EQ(fault({{Vector3::Zero(), one}, hollow, {{0.4, 0.4, 0.4}, 0.2 * one, true}}), Kind::inside_out);
  EXPECT_EQ(fault({{Vector3::Zero(), one}, {{3, 0, 0}, one, true}}), Kind::inside_out) << "apart, as large";
  EXPECT_EQ(fault({{Vector3::Zero(), one}, {{3, 0, 0}, 0.5 * one, true}}), Kind::inside_out);
}

}  // namespace
}  // namespace sazare::geometry
