#include "sazare/methods/blocks/run/blasting/hole_wall.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sazare::runs {
namespace {

constexpr Real radius = 0.05, length = 2.0;
constexpr int sides = 12;

/// The wall of a prism with a regular base, of which the corners lie at the radius; its faces look into the hole.
struct Prism {
  geometry::TetraMesh mesh;
  std::vector<geometry::OuterFace> faces;

  Prism(const Vector3& toe, const Quaternion& turn) {
    const auto node = [&](int side, Real along) {
      const Real angle = 2 * std::numbers::pi * side / sides;
      mesh.nodes.push_back(toe + turn * Vector3(radius * std::cos(angle), radius * std::sin(angle), along));
      return static_cast<std::int32_t>(mesh.nodes.size() - 1);
    };
    for (int side = 0; side < sides; ++side) {
      const auto a = node(side, 0), b = node(side + 1, 0), c = node(side + 1, length), d = node(side, length);
      for (const auto& nodes : {std::array{a, c, b}, std::array{a, d, c}}) {
        geometry::OuterFace& face = faces.emplace_back();
        face.nodes = nodes;
      }
    }
  }
};

TEST(HoleWall, OfAPrismHasItsAxisItsEndsAndTheDiameterOfItsVolume) {
  const Vector3 toe(1, -2, 3);
  const Quaternion turn(Eigen::AngleAxis<Real>(0.7, Vector3(1, 2, -0.5).normalized()));
  const Prism prism(toe, turn);
  const HoleWall wall = measure_wall(prism.mesh, prism.faces);
  EXPECT_TRUE(wall.closes());
  EXPECT_LT((wall.first - toe).norm(), 1e-12);
  EXPECT_LT((wall.last - (toe + turn * Vector3(0, 0, length))).norm(), 1e-12);
  EXPECT_NEAR(wall.length, length, 1e-12);
  const Real base = 0.5 * sides * radius * radius * std::sin(2 * std::numbers::pi / sides);
  EXPECT_NEAR(wall.diameter, std::sqrt(4 * base / std::numbers::pi), 1e-12);
  EXPECT_NEAR(wall.volume, base * length, 1e-12);
}

TEST(HoleWall, OfHalfAPrismIsNotThatOfAHole) {
  Prism prism(Vector3::Zero(), Quaternion::Identity());
  prism.faces.resize(prism.faces.size() / 2);
  EXPECT_FALSE(measure_wall(prism.mesh, prism.faces).closes());
}

}  // namespace
}  // namespace sazare::runs
