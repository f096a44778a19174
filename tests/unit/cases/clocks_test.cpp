#include <gtest/gtest.h>

#include "case_folder.hpp"
#include "sazare/cases/clocks.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::cases {
namespace {

TEST(Clocks, WholeMultiplesIncludeRoundOff) {
  EXPECT_EQ(whole_multiple(5e-4, 1e-6), 500);
  EXPECT_EQ(whole_multiple(0.3, 0.1), 3);
  EXPECT_EQ(whole_multiple(1, 1), 1);
  EXPECT_FALSE(whole_multiple(5e-4, 3e-6));
  EXPECT_FALSE(whole_multiple(1, 2));
  EXPECT_FALSE(whole_multiple(1, 0));
  EXPECT_FALSE(whole_multiple(1, 1.0 / 3.0001));
}

TEST(Clocks, DivisorsNearAWish) {
  EXPECT_EQ(nearest_divisor(50000, 200), 200);
  EXPECT_EQ(nearest_divisor(13, 5), 13);
  EXPECT_EQ(nearest_divisor(1, 20), 1);
  EXPECT_EQ(nearest_divisor_by_length(250, 20), 25);
}

TEST(Clocks, FractionsThatNest) {
  EXPECT_EQ(nearest_fraction(5e-4, 1e-3), 5e-4);
  EXPECT_EQ(nearest_fraction(1, 0.24), 0.25);
  EXPECT_TRUE(whole_multiple(5e-4, nearest_fraction(5e-4, 3e-6)));
  EXPECT_EQ(round_fraction(5e-4, 3e-6, {}), 2.5e-6);
  EXPECT_EQ(whole_fraction(5e-4, 200), 2.5e-6);
}

void expect_nested(const Time& time) {
  EXPECT_TRUE(whole_multiple(time.end, time.snapshot_interval)) << time.snapshot_interval;
  EXPECT_TRUE(whole_multiple(time.snapshot_interval, time.history_interval)) << time.history_interval;
  if (time.base_step) {
    EXPECT_TRUE(whole_multiple(time.history_interval, *time.base_step));
  }
}

TEST(Clocks, DefaultsAreAboutTwoHundredRowsAndTwentySnapshots) {
  const CaseFolder folder;
  const Time time = folder.read(smallest_case()).as<cases::BlocksCase>().time;
  EXPECT_EQ(whole_multiple(time.end, time.history_interval), 200);
  EXPECT_EQ(whole_multiple(time.end, time.snapshot_interval), 20);
}

TEST(Clocks, DefaultsNestWithWhatIsGiven) {
  const CaseFolder folder;
  const std::vector<std::vector<std::string>> settings{
      {"time.history_interval=2e-6"},
      {"time.snapshot_interval=1e-4"},
      {"time.snapshot_interval=5e-4"},
      {"time.snapshot_interval=1e-7"},
      {"time.base_step=1e-8"},
      {"time.base_step=1e-8", "time.snapshot_interval=5e-6"},
      {"time.base_step=2e-7", "time.history_interval=4e-6"},
      {"time.base_step=5e-4"},
      {"time.end=7.3e-4"},
      {"time.end=7.3e-4", "time.base_step=1e-8"},
      {"time.end=1", "time.history_interval=0.1"},
  };
  for (const auto& overrides : settings) {
    SCOPED_TRACE(overrides.front() + " " + overrides.back());
    expect_nested(folder.read(smallest_case(), overrides).as<cases::BlocksCase>().time);
  }
}

TEST(Clocks, TheSuggestedIntervalIsAccepted) {
  const CaseFolder folder;
  const std::vector<std::pair<std::string, std::vector<std::string>>> wrong{
      {"history_interval", {"time.history_interval=3.3e-6"}},
      {"history_interval", {"time.base_step=2e-8", "time.history_interval=3.125e-5"}},
      {"snapshot_interval", {"time.history_interval=2e-6", "time.snapshot_interval=2.3e-5"}},
      {"snapshot_interval", {"time.snapshot_interval=7e-5"}},
      {"base_step", {"time.base_step=3.7e-8"}},
  };
  for (const auto& [key, overrides] : wrong) {
    const std::string message = folder.refusal(smallest_case(), overrides);
    const std::string words = "the nearest " + key + " that does is ";
    const std::size_t at = message.find(words);
    ASSERT_NE(at, std::string::npos) << message;
    const std::size_t begin = at + words.size();
    auto corrected = overrides;
    corrected.push_back("time." + key + "=" + message.substr(begin, message.find_first_of(",\n", begin) - begin));
    EXPECT_NO_THROW(expect_nested(folder.read(smallest_case(), corrected).as<cases::BlocksCase>().time)) << corrected.back();
  }
}

}  // namespace
}  // namespace sazare::cases
