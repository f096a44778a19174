#include "sazare/neighbors/sphere_pairs.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <vector>

#include "sazare/neighbors/sphere_cells.hpp"

namespace sazare::neighbors {
namespace {

class Random {
public:
  Real operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<Real>(state_ >> 11) / 9007199254740992.0;
  }

private:
  std::uint64_t state_ = 7;
};

state::Spheres scattered(int count, Real smallest, Real largest, const Vector3& room) {
  state::Spheres spheres;
  Random random;
  for (int i = 0; i < count; ++i) {
    const Vector3 centre(room.x() * random(), room.y() * random(), room.z() * random());
    spheres.add(centre, smallest * std::pow(largest / smallest, random()), 1000, 0);
  }
  return spheres;
}

using Pairs = std::set<std::pair<Index, Index>>;

Pairs found(const state::Spheres& spheres, Real margin) {
  const SpherePairs list = find_pairs(spheres, margin);
  Pairs pairs;
  EXPECT_EQ(list.first.size(), spheres.size() + 1);
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t p = list.first[i]; p < list.first[i + 1]; ++p) {
      EXPECT_GT(list.other[p], static_cast<Index>(i));
      EXPECT_TRUE(pairs.insert({static_cast<Index>(i), list.other[p]}).second) << "twice";
    }
  return pairs;
}

Pairs by_hand(const state::Spheres& spheres, Real margin) {
  Pairs pairs;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (std::size_t j = i + 1; j < spheres.size(); ++j) {
      Vector3 apart = spheres.place[j].centre() - spheres.place[i].centre();
      for (int axis = 0; axis < 3; ++axis)
        if (spheres.box.length[axis] > 0) apart[axis] = std::remainder(apart[axis], spheres.box.length[axis]);
      if (apart.norm() < spheres.place[i].radius + spheres.place[j].radius + margin)
        pairs.insert({static_cast<Index>(i), static_cast<Index>(j)});
    }
  return pairs;
}

/// Each wanted tile has the pairs, in the same order, of a search in all tiles; the others have none.
void expect_wanted_pairs(const SpherePairs& all, const SpherePairs& some, std::span<const std::uint8_t> is_wanted) {
  ASSERT_EQ(some.first.size(), all.first.size());
  for (std::size_t i = 0; i + 1 < all.first.size(); ++i) {
    const std::vector<Index> expected(all.other.begin() + all.first[i], all.other.begin() + all.first[i + 1]),
        pairs(some.other.begin() + some.first[i], some.other.begin() + some.first[i + 1]);
    EXPECT_EQ(pairs, is_wanted[i / tile_size] != 0 ? expected : std::vector<Index>{});
  }
}

TEST(sphere_pairs, of_wanted_tiles_are_those_of_a_search_in_all) {
  for (const Real largest : {0.02, 0.08}) {
    auto spheres = scattered(4000, 0.02, largest, {1, 1, 1});
    put_in_order(spheres, order_by_cell(spheres, 0.01));
    const SpherePairs all = find_pairs(spheres, 0.01);
    for (const std::array<std::uint8_t, 4>& wanted : {std::array<std::uint8_t, 4>{1, 0, 1, 0}, {0, 1, 0, 1}, {0, 0, 0, 1}}) {
      expect_wanted_pairs(all, find_pairs(spheres, 0.01, wanted), wanted);
      SpherePairs kept = all;
      keep_wanted(kept, wanted);
      expect_wanted_pairs(all, kept, wanted);
    }
  }
}

/// The places of the spheres of wanted tiles and of those within the margin of them.
std::vector<Index> near_wanted(const state::Spheres& spheres, Real margin, std::span<const std::uint8_t> is_wanted) {
  std::vector<std::uint8_t> is_near(spheres.size(), 0);
  for (std::size_t i = 0; i < spheres.size(); ++i) is_near[i] = is_wanted[i / tile_size];
  for (const auto& [one, other] : by_hand(spheres, margin)) {
    const auto i = static_cast<std::size_t>(one), j = static_cast<std::size_t>(other);
    if (is_wanted[i / tile_size] != 0 || is_wanted[j / tile_size] != 0) is_near[i] = is_near[j] = 1;
  }
  std::vector<Index> places;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    if (is_near[i] != 0) places.push_back(static_cast<Index>(i));
  return places;
}

TEST(sphere_pairs, of_wanted_tiles_need_what_is_near_these_alone) {
  for (const Real largest : {0.02, 0.08}) {
    auto spheres = scattered(4000, 0.02, largest, {1, 1, 1});
    spheres.box = {Vector3::Zero(), Vector3(0, 1, 0)};
    put_in_order(spheres, order_by_cell(spheres, 0.01));
    const SpherePairs all = find_pairs(spheres, 0.01);
    const SphereSizes sizes(spheres);
    for (const std::array<std::uint8_t, 4>& wanted : {std::array<std::uint8_t, 4>{1, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}) {
      const std::vector<Index> known = near_wanted(spheres, 0.01, wanted);
      state::Spheres part = spheres;
      for (auto& place : part.place) place = {};
      for (const Index i : known) part.place[static_cast<std::size_t>(i)] = spheres.place[static_cast<std::size_t>(i)];
      ASSERT_LT(known.size(), spheres.size());
      expect_wanted_pairs(all, find_pairs(part, 0.01, wanted, {sizes, known}), wanted);
    }
  }
}

TEST(sphere_pairs, are_all_pairs_of_one_size) {
  const auto spheres = scattered(2000, 0.05, 0.05, {1, 1, 1});
  EXPECT_EQ(found(spheres, 0.01), by_hand(spheres, 0.01));
}

TEST(sphere_pairs, are_all_pairs_of_sizes_one_to_twenty) {
  const auto spheres = scattered(3000, 0.01, 0.2, {2, 1, 1.5});
  EXPECT_EQ(found(spheres, 0.002), by_hand(spheres, 0.002));
}

TEST(sphere_pairs, reach_through_periodic_sides) {
  for (const Vector3& length : {Vector3(1, 1, 0), Vector3(0.25, 1, 1), Vector3(0, 0.5, 0)}) {
    auto spheres = scattered(1500, 0.02, 0.05, {1, 1, 1});
    spheres.box = {Vector3(-0.1, 0.2, 0), length};
    EXPECT_EQ(found(spheres, 0.005), by_hand(spheres, 0.005));
  }
}

TEST(sphere_pairs, are_found_however_far_some_have_gone) {
  auto spheres = scattered(500, 0.05, 0.05, {1, 1, 1});
  for (std::size_t i = 0; i < 10; ++i) spheres.place[i].z += 1e9;
  EXPECT_EQ(found(spheres, 0.01), by_hand(spheres, 0.01));
}

TEST(sphere_pairs, order_along_the_curve_holds_each_once) {
  const auto spheres = scattered(1000, 0.02, 0.05, {1, 1, 1});
  const auto order = order_by_cell(spheres, 0.01);
  EXPECT_EQ(std::set<Index>(order.begin(), order.end()).size(), spheres.size());
}

TEST(sphere_pairs, of_spheres_at_no_place_stand_in_the_first_cells) {
  auto spheres = scattered(1000, 0.02, 0.05, {1, 1, 1});
  const CellGrid grid({}, SphereSizes(spheres), 0.1);
  constexpr Real none = std::numeric_limits<Real>::quiet_NaN(), infinity = std::numeric_limits<Real>::infinity();
  EXPECT_EQ(grid.place_of({none, -1e300, -infinity}), (CellPlace{0, 0, 0}));
  EXPECT_EQ(grid.place_of({1e300, 1e300, 1e300}), (CellPlace{9, 9, 9}));
}

TEST(sphere_pairs, of_no_spheres_are_none) { EXPECT_TRUE(find_pairs({}, 0.1).other.empty()); }

}  // namespace
}  // namespace sazare::neighbors
