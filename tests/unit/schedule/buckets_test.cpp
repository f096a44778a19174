#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "sazare/levels/schedule/levels.hpp"

namespace sazare::schedule {
namespace {

using Levels = std::map<Index, int>;

void expect_same(const Buckets& buckets, const Levels& expected) {
  ASSERT_EQ(buckets.size(), expected.size());
  int finest = Buckets::absent;
  std::array<std::vector<Index>, level_count> sorted;
  for (const auto& [item, level] : expected) {
    EXPECT_TRUE(buckets.holds(item));
    EXPECT_EQ(buckets.level(item), level);
    finest = std::max(finest, level);
    sorted[static_cast<std::size_t>(level)].push_back(item);
  }
  EXPECT_EQ(buckets.finest(), finest);
  for (int level = 0; level <= deepest_level; ++level) {
    std::vector<Index> found(buckets.at(level).begin(), buckets.at(level).end());
    std::ranges::sort(found);
    EXPECT_EQ(found, sorted[static_cast<std::size_t>(level)]);
  }
}

TEST(buckets, stay_right_through_random_moves) {
  std::mt19937_64 random(11);
  Buckets buckets;
  Levels expected;
  for (int round = 0; round < 3000; ++round) {
    const auto item = static_cast<Index>(random() % 40);
    const int level = static_cast<int>(random() % level_count);
    const bool known = expected.contains(item);
    if (!known) {
      buckets.insert(item, level);
      expected[item] = level;
    } else if (random() % 3 == 0) {
      buckets.erase(item);
      expected.erase(item);
    } else {
      buckets.move(item, level);
      expected[item] = level;
    }
    if (round % 7 == 0) buckets.sort();
    if (round % 50 == 0) expect_same(buckets, expected);
  }
  expect_same(buckets, expected);
}

TEST(buckets, sorted_they_rise) {
  Buckets buckets;
  for (const Index item : {5, 1, 9, 3, 7}) buckets.insert(item, 2);
  buckets.erase(1);
  buckets.sort();
  const std::vector<Index> found(buckets.at(2).begin(), buckets.at(2).end());
  EXPECT_EQ(found, (std::vector<Index>{3, 5, 7, 9}));
  buckets.move(5, 4);  // places are still known after sorting
  EXPECT_EQ(buckets.at(2).size(), 3u);
  EXPECT_EQ(buckets.at(4).size(), 1u);
}

TEST(buckets, listed_from_a_level_all_finer_items_come) {
  Buckets buckets;
  for (const Index item : {5, 1, 9, 3, 7}) buckets.insert(item, static_cast<int>(item));
  std::vector<Index> items = {42};
  buckets.list_from(5, items);
  std::ranges::sort(items);
  EXPECT_EQ(items, (std::vector<Index>{5, 7, 9}));
  buckets.list_from(10, items);
  EXPECT_TRUE(items.empty());
}

TEST(buckets, many_are_listed_in_rising_order) {
  Buckets buckets;
  const Index count = 10'007;  // no whole number of registers
  std::vector<Index> expected;
  for (Index place = 0; place < count; ++place) {
    const Index item = place * 7919 % count;  // every item once, in no order
    if (item != 17) buckets.insert(item, static_cast<int>(item % 5));
  }
  for (Index item = 0; item < count; ++item)
    if (item != 17 && item % 5 >= 2) expected.push_back(item);
  std::vector<Index> items;
  buckets.list_from(2, items);
  EXPECT_EQ(items, expected);
}

TEST(buckets, rebuilt_from_their_levels_they_hold_the_same) {
  Buckets buckets, copy;
  for (const Index item : {4, 0, 2}) buckets.insert(item, static_cast<int>(item));
  copy.insert(1, 1);
  copy.assign(buckets.levels());
  expect_same(copy, {{0, 0}, {2, 2}, {4, 4}});
  EXPECT_FALSE(copy.holds(1));
}

}  // namespace
}  // namespace sazare::schedule
