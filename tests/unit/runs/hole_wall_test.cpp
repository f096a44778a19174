#include "sazare/methods/blocks/run/blasting/hole_wall.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/methods/blocks/run/blasting/blast_walls.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::runs {
namespace {

constexpr Real radius = 0.05, length = 2.0;

/// The wall of a prism with a regular base, of which the corners lie at the radius; its faces look into the hole.
struct Prism {
  geometry::TetraMesh mesh;
  std::vector<geometry::OuterFace> faces;

  Prism(const Vector3& toe, const Quaternion& turn, int sides = 12) {
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
  constexpr int sides = 12;
  const Real base = 0.5 * sides * radius * radius * std::sin(2 * std::numbers::pi / sides);
  EXPECT_NEAR(wall.diameter, std::sqrt(4 * base / std::numbers::pi), 1e-12);
  EXPECT_NEAR(wall.volume, base * length, 1e-12);
}

TEST(HoleWall, OfHalfAPrismIsNotThatOfAHole) {
  Prism prism(Vector3::Zero(), Quaternion::Identity());
  prism.faces.resize(prism.faces.size() / 2);
  EXPECT_FALSE(measure_wall(prism.mesh, prism.faces).closes());
}

std::string said_of(const HoleWall& wall) {
  const cases::CaseFile file = registry::read_case_text(
      "[case]\ntitle = \"Hole\"\nmethod = \"blocks\"\n[mesh]\nfile = \"tests/regression/block/block.msh\"\n"
      "[[materials]]\nname = \"rock\"\nregions = [\"rock\"]\ndensity = 2390.0\n"
      "[[joints]]\nname = \"rock\"\nbetween = [\"rock\", \"rock\"]\njoint_normal_stiffness = 450e9\njoint_shear_stiffness = "
      "90e9\n"
      "cohesion = 6e6\nfriction_coefficient = 0.58\ntensile_strength = 6e6\nfracture_energy = 100.0\n"
      "[contact]\ncontact_stiffness = 1.5e9\nfriction_coefficient = 0.58\n"
      "[[blasts]]\nsurface = \"hole\"\npeak_pressure = 5e8\nrise_time = 1e-4\ndecay_ratio = 2.0\n[time]\nend = 5e-4\n",
      "case.toml");
  return warn_of_blast_walls(file, {wall});
}

TEST(BlastWalls, ThatAreHolesOfTheFieldAreLeftAlone) {
  const Prism prism(Vector3::Zero(), Quaternion::Identity());
  EXPECT_EQ(said_of(measure_wall(prism.mesh, prism.faces)), "");
  EXPECT_EQ(said_of(HoleWall{}), "");
}

TEST(BlastWalls, OfWhichTheGroupHasHalfAreWarnedOf) {
  Prism prism(Vector3::Zero(), Quaternion::Identity());
  prism.faces.resize(prism.faces.size() / 2);
  const std::string words = said_of(measure_wall(prism.mesh, prism.faces));  // twice the radius over half of 12 sides
  EXPECT_NE(
      words.find("case.toml:23:11: warning: the faces of this surface turn around, but do not close: 64.4 % of the pressure"),
      std::string::npos)
      << words;
  prism.faces.resize(2);  // flat: a load, as in a spalling test
  EXPECT_EQ(said_of(measure_wall(prism.mesh, prism.faces)), "");
}

TEST(BlastWalls, OfOneElementAcrossAreWarnedOf) {
  const Prism square(Vector3::Zero(), Quaternion::Identity(), 4);
  const std::string words = said_of(measure_wall(square.mesh, square.faces));
  EXPECT_NE(words.find("faces around"), std::string::npos) << words;
}

TEST(BlastWalls, InMillimetresAreWarnedOf) {
  Prism prism(Vector3::Zero(), Quaternion::Identity());
  for (Vector3& node : prism.mesh.nodes) node *= 1000;
  const std::string words = said_of(measure_wall(prism.mesh, prism.faces));
  EXPECT_NE(words.find("the hole is 97.7 m across"), std::string::npos) << words;
  EXPECT_NE(words.find("set scale = 0.001 in [mesh]: it is then 0.0977 m across"), std::string::npos) << words;
}

}  // namespace
}  // namespace sazare::runs
