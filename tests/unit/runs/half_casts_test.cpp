#include "sazare/methods/blocks/run/blasting/half_casts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace sazare::runs {
namespace {

constexpr Real radius = 0.05, length = 2.0;
constexpr int sides = 8, levels = 4;  // faces around, and along the hole

const Vector3 toe(1, -2, 3);
const Quaternion turn(Eigen::AngleAxis<Real>(0.7, Vector3(1, 2, -0.5).normalized()));

/// Rock around a hole with an octagonal base: behind each half of a rectangle of its wall stands a tetrahedron.
struct Rock {
  geometry::TetraMesh mesh;
  std::vector<int> side, level;  ///< of every element

  /// A rock with only the first so many sides of the wall.
  explicit Rock(int present = sides) {
    mesh.region_names = {"rock"};
    mesh.surfaces.resize(1);
    mesh.surfaces[0].name = "hole";
    for (int place = 0; place < present; ++place)
      for (int high = 0; high < levels; ++high) add_rectangle(place, high);
  }

  std::vector<bool> stays(const std::function<bool(int, int)>& chosen) const {
    std::vector<bool> found;
    for (std::size_t i = 0; i < side.size(); ++i) found.push_back(chosen(side[i], level[i]));
    return found;
  }

private:
  std::int32_t node(Real distance, Real angle, Real along) {
    mesh.nodes.push_back(toe + turn * Vector3(distance * std::cos(angle), distance * std::sin(angle), along));
    return static_cast<std::int32_t>(mesh.nodes.size() - 1);
  }

  void add_rectangle(int place, int high) {
    const Real angle = 2 * std::numbers::pi / sides, step = length / levels;
    const auto corner = [&](int i, int j) { return node(radius, (place + i) * angle, (high + j) * step); };
    for (const int half : {0, 1}) {
      const auto a = corner(0, 0), b = corner(1, half == 0 ? 0 : 1), c = half == 0 ? corner(1, 1) : corner(0, 1);
      const auto behind = node(3 * radius, (place + 0.5) * angle, (high + 0.5) * step);
      mesh.tetrahedra.push_back({a, b, c, behind});
      mesh.region.push_back(0);
      mesh.surfaces[0].triangles.push_back({a, b, c});
      side.push_back(place);
      level.push_back(high);
    }
  }
};

cases::BlocksCase with_charge() {
  cases::BlocksCase blocks;
  cases::Charge& charge = blocks.charges.emplace_back();
  charge.surface = "hole";
  charge.toe = toe;
  charge.collar = toe + turn * Vector3(0, 0, length);
  charge.diameter = 2 * radius;
  return blocks;
}

HalfCast one_cast(const Rock& rock, const std::function<bool(int, int)>& chosen) {
  const auto casts = measure_half_casts(with_charge(), rock.mesh, rock.stays(chosen));
  EXPECT_EQ(casts.size(), 1u);
  return casts.at(0);
}

TEST(HalfCasts, AHoleThatHasNotBrokenOutIsWhole) {
  const HalfCast cast = one_cast(Rock(), [](int, int) { return true; });
  EXPECT_EQ(cast.surface, "hole");
  EXPECT_NEAR(cast.length(), length, 1e-12);
  EXPECT_NEAR(cast.half, length, 1e-12);
  EXPECT_NEAR(cast.whole, length, 1e-12);
  EXPECT_NEAR(cast.standing, 1, 1e-12);
  EXPECT_NEAR((cast.first - (toe + turn * Vector3(0, 0, length))).norm(), 0, 1e-12);  // from the collar on
}

TEST(HalfCasts, WhereAllIsGoneNothingIsLeft) {
  const HalfCast cast = one_cast(Rock(), [](int, int) { return false; });
  EXPECT_EQ(cast.half, 0);
  EXPECT_EQ(cast.whole, 0);
  EXPECT_EQ(cast.standing, 0);
}

TEST(HalfCasts, AHalfBarrelOverAPartOfTheLengthCountsByItsLength) {
  const HalfCast cast = one_cast(Rock(), [](int side, int level) { return side < sides / 2 && level > 0; });
  EXPECT_NEAR(cast.half, 0.75 * length, 1e-12);
  EXPECT_EQ(cast.whole, 0);
  EXPECT_NEAR(cast.standing, 0.375, 1e-12);
}

TEST(HalfCasts, OneFaceLessThanHalfIsAHalfBarrelAndTwoLessAreNone) {
  EXPECT_NEAR(one_cast(Rock(), [](int side, int) { return side < sides / 2 - 1; }).half, length, 1e-12);
  EXPECT_EQ(one_cast(Rock(), [](int side, int) { return side < sides / 2 - 2; }).half, 0);
}

TEST(HalfCasts, OfHalfAHoleOnAPlaneOfSymmetryIsThatOfTheWholeHole) {
  const Rock rock(sides / 2);
  EXPECT_NEAR(one_cast(rock, [](int side, int level) { return side < sides / 4 && level != 1; }).half, 0.75 * length, 1e-12);
  EXPECT_EQ(one_cast(rock, [](int, int) { return false; }).half, 0);
  EXPECT_NEAR(one_cast(rock, [](int, int) { return true; }).whole, length, 1e-12);
}

TEST(HalfCasts, DecksOfOneHoleAreOneAndABlastFindsItsAxisItself) {
  cases::BlocksCase blocks = with_charge();
  blocks.charges.push_back(blocks.charges[0]);
  const Rock rock;
  const auto upper = rock.stays([](int, int level) { return level > 0; });
  EXPECT_EQ(measure_half_casts(blocks, rock.mesh, upper).size(), 1u);
  blocks.charges.clear();
  blocks.blasts.emplace_back().surface = "hole";
  const auto casts = measure_half_casts(blocks, rock.mesh, upper);
  ASSERT_EQ(casts.size(), 1u);
  EXPECT_NEAR(casts[0].half, 0.75 * length, 1e-12);
}

TEST(HalfCasts, TheFactorWeighsHolesByTheirLength) {
  HalfCast lost, left;
  lost.last = Vector3(0, 0, 3);
  left.last = Vector3(0, 0, 1);
  left.half = 1;
  EXPECT_DOUBLE_EQ(half_cast_factor({lost, left}), 0.25);
  EXPECT_EQ(half_cast_factor({}), 0);
}

}  // namespace
}  // namespace sazare::runs
