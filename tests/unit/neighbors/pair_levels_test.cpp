#include "sazare/neighbors/pair_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace sazare::neighbors {
namespace {

constexpr Real margin = 0.02;
constexpr int finest = 3;

/// Spheres at random places, the smaller ones at finer levels; among them a level without any sphere.
struct Scene {
  state::Spheres spheres;
  std::vector<std::int8_t> level;

  explicit Scene(std::size_t count) {
    std::uint64_t state = 7;
    const auto random = [&] {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      return static_cast<Real>(state >> 11) / 9007199254740992.0;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const std::int8_t own = random() < 0.7 ? 0 : random() < 0.5 ? 1 : 3;
      const Real x = random(), y = random(), z = random();
      spheres.add({x, y, z}, 0.05 * std::exp2(-own), 1, 0);
      level.push_back(own);
    }
  }
};

TEST(pair_levels, are_all_pairs_once_each_at_the_finer_level_of_its_spheres) {
  Scene scene(700);
  const SpherePairs all = find_pairs(scene.spheres, margin);
  std::set<std::array<Index, 3>> expected, found;
  for (std::size_t i = 0; i < scene.level.size(); ++i)
    for (std::size_t p = all.first[i]; p < all.first[i + 1]; ++p) {
      const auto j = static_cast<std::size_t>(all.other[p]);
      expected.insert({std::max(scene.level[i], scene.level[j]), static_cast<Index>(i), static_cast<Index>(j)});
    }
  const LeveledPairs leveled = find_leveled_pairs(scene.spheres, margin, {scene.level, finest});
  std::size_t count = 0;
  for (std::size_t l = 0; l < leveled.pairs.size(); ++l) {
    const SpherePairs& pairs = leveled.pairs[l];
    ASSERT_EQ(pairs.first.size(), leveled.spheres[l] + 1);
    count += pairs.other.size();
    for (std::size_t n = 0; n < leveled.spheres[l]; ++n)
      for (std::size_t p = pairs.first[n]; p < pairs.first[n + 1]; ++p) {
        EXPECT_GT(pairs.other[p], static_cast<Index>(n));
        EXPECT_LT(pairs.other[p], static_cast<Index>(leveled.spheres[l]));
        const Index i = leveled.order[n], j = leveled.order[static_cast<std::size_t>(pairs.other[p])];
        found.insert({static_cast<Index>(l), std::min(i, j), std::max(i, j)});
      }
  }
  EXPECT_GT(expected.size(), 500U);
  EXPECT_EQ(count, expected.size());
  EXPECT_EQ(found, expected);
}

TEST(pair_levels, put_the_spheres_of_an_active_level_or_a_finer_one_first) {
  const Scene scene(400);
  const SpherePairs all = find_pairs(scene.spheres, margin);
  std::vector<std::int8_t> active = scene.level;
  for (std::size_t i = 0; i < active.size(); ++i)
    for (std::size_t p = all.first[i]; p < all.first[i + 1]; ++p) {
      const auto j = static_cast<std::size_t>(all.other[p]);
      active[i] = std::max(active[i], scene.level[j]);
      active[j] = std::max(active[j], scene.level[i]);
    }
  const LeveledPairs leveled = find_leveled_pairs(scene.spheres, margin, {scene.level, finest});
  ASSERT_EQ(leveled.spheres.size(), finest + 1U);
  EXPECT_EQ(leveled.spheres[0], active.size());
  EXPECT_EQ(leveled.spheres[2], leveled.spheres[3]);  // nobody has level 2
  for (std::size_t n = 0; n < active.size(); ++n)
    for (std::size_t l = 0; l < leveled.spheres.size(); ++l)
      EXPECT_EQ(n < leveled.spheres[l], active[static_cast<std::size_t>(leveled.order[n])] >= static_cast<std::int8_t>(l));
  const std::set<Index> each(leveled.order.begin(), leveled.order.end());
  EXPECT_EQ(each.size(), active.size());
}

TEST(pair_levels, bonds_and_bodies_quicken_spheres_that_are_far_apart) {
  state::Spheres spheres;
  for (int n = 0; n < 5; ++n) spheres.add(Vector3(n, 0, 0), 0.1, 2500, 0);
  const std::vector<std::int8_t> level = {3, 0, 0, 0, 1};
  LevelsByPlace levels{level, 3};
  levels.bonded = {{1, 0}};
  levels.body = {-1, 7, 7, -1, -1};
  const LeveledPairs leveled = find_leveled_pairs(spheres, 0.01, levels);
  EXPECT_EQ(leveled.spheres, (std::vector<std::size_t>{5, 4, 3, 3}));
  EXPECT_EQ(std::set<Index>(leveled.order.begin(), leveled.order.begin() + 3), (std::set<Index>{0, 1, 2}));
  EXPECT_EQ(leveled.order[3], 4);
}

}  // namespace
}  // namespace sazare::neighbors
