#include "sazare/methods/blocks/run/model.hpp"

#include <gtest/gtest.h>

#include "sazare/core/error.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

cases::Time blast_clocks() {
  cases::Time time;
  time.end = 5e-4;
  time.history_interval = 1e-6;
  time.snapshot_interval = 2.5e-5;
  return time;
}

TEST(RunClocks, AreWholeNumbersOfOneAnother) {
  const RunClocks clocks = clocks_of(blast_clocks(), 1e-6 / 3);
  EXPECT_EQ(clocks.rows, 500);
  EXPECT_EQ(clocks.steps_per_row, 3);
  EXPECT_EQ(clocks.rows_per_snapshot, 25);
  EXPECT_EQ(clocks.steps(), 1500);
  EXPECT_TRUE(clocks.is_row(6));
  EXPECT_FALSE(clocks.is_row(7));
  EXPECT_TRUE(clocks.is_snapshot(150));
  EXPECT_FALSE(clocks.is_snapshot(78));
}

TEST(RunClocks, GiveTimesWithoutSums) {
  const RunClocks clocks = clocks_of(blast_clocks(), 1e-6 / 3);
  EXPECT_EQ(clocks.time(9), 3e-6);
  EXPECT_EQ(clocks.time(1500), 5e-4);
  EXPECT_NEAR(clocks.time(7), 7e-6 / 3, 1e-20);
}

TEST(RunClocks, RefuseABaseStepThatDoesNotFit) {
  const std::string words = test::words_of<UserError>([] { clocks_of(blast_clocks(), 3e-7); });
  EXPECT_EQ(words, "clocks do not nest: history_interval = 1e-06 s is not a whole multiple of base_step = 3e-07 s");
}

}  // namespace
}  // namespace sazare::runs
