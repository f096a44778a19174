#include <gtest/gtest.h>

#include <random>

#include "sazare/levels/schedule/levels.hpp"

namespace sazare::schedule {
namespace {

TEST(levels, each_level_halves_the_stride) {
  EXPECT_EQ(stride(0), base_stride);
  for (int level = 1; level <= deepest_level; ++level) EXPECT_EQ(2 * stride(level), stride(level - 1));
  EXPECT_EQ(stride(deepest_level), 2);  // a half step is still a whole tick
}

TEST(levels, due_at_multiples_of_the_stride) {
  EXPECT_TRUE(due_at(0, 0));
  EXPECT_TRUE(due_at(3, 5 * stride(3)));
  EXPECT_FALSE(due_at(2, 5 * stride(3)));
  EXPECT_FALSE(due_at(3, 5 * stride(3) + 1));
}

TEST(levels, the_coarsest_that_is_due_is_the_first_that_divides_the_tick) {
  std::mt19937_64 random(3);
  for (int sample = 0; sample < 2000; ++sample) {
    const int finest = static_cast<int>(random() % level_count);
    const Tick tick = static_cast<Tick>(random() % 1000) * stride(finest);
    int coarsest = 0;
    while (!due_at(coarsest, tick)) ++coarsest;
    EXPECT_EQ(coarsest_due(tick), coarsest) << tick;
    for (int level = coarsest; level <= deepest_level; ++level) EXPECT_TRUE(due_at(level, tick));
  }
}

TEST(levels, the_level_for_a_step_is_the_coarsest_that_fits) {
  EXPECT_EQ(level_for(1e-6, 1e-6), 0);
  EXPECT_EQ(level_for(2e-6, 1e-6), 0);
  EXPECT_EQ(level_for(0.99e-6, 1e-6), 1);
  EXPECT_EQ(level_for(0.5e-6, 1e-6), 1);
  EXPECT_EQ(level_for(1e-6 / 1024, 1e-6), 10);
  EXPECT_EQ(level_for(0, 1e-6), deepest_level);
}

}  // namespace
}  // namespace sazare::schedule
