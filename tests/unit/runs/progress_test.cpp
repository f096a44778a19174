#include "sazare/runs/progress.hpp"

#include <gtest/gtest.h>

namespace sazare::runs {
namespace {

TEST(Progress, WritesDurationsAsPeopleSayThem) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(3599), "59 min 59 s");
  EXPECT_EQ(duration_text(3900), "1 h 05 min");
  EXPECT_EQ(duration_text(1e300), "2562047788015215 h 30 min");
}

TEST(Progress, TellsShareTimeLeftRateAndSmallestStep) {
  EXPECT_EQ(progress_text({}, {0.25, 1e-4, 3000000, 6.25e-9, 12}, 3),
            " 25 %  t = 100e-6 s  9 s left  1.0e+06 evaluations/s  smallest step 6.25e-9 s  12 broken joints");
}

TEST(Progress, CountsTheTimeLeftFromWhereTheRunWasResumed) {
  const ProgressState resumed{0.5, 2e-4, 1000, 1e-8, 0}, now{0.75, 3e-4, 3000, 1e-8, 0};
  EXPECT_EQ(progress_text(resumed, now, 10),
            " 75 %  t = 300e-6 s  10 s left  2.0e+02 evaluations/s  smallest step 10e-9 s  0 broken joints");
}

}  // namespace
}  // namespace sazare::runs
