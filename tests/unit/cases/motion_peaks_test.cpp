/// The largest acceleration, velocity and displacement of motions whose peaks are known.

#include "sazare/cases/motion_peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_folder.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::cases {
namespace {

Motion of_type(MotionShape type) {
  Motion motion;
  motion.type = type;
  return motion;
}

TEST(motion_peaks, of_a_sine_follow_from_its_frequency) {
  Motion sine = of_type(MotionShape::sine);
  sine.amplitude = 3;
  sine.frequency = 2;
  const auto peaks = peaks_of(sine, 10);
  const Real omega = 4 * std::numbers::pi;
  ASSERT_TRUE(peaks);
  EXPECT_NEAR(peaks->acceleration, 3, 1e-3);
  EXPECT_NEAR(peaks->velocity, 2 * 3 / omega, 1e-3 * 6 / omega);  // it starts from rest: v = a/w (1 - cos wt)
  EXPECT_NEAR(peaks->displacement, 3 / omega * 10, 1e-3 * 30 / omega);
}

TEST(motion_peaks, of_a_record_are_those_until_the_end_of_the_run) {
  Motion record = of_type(MotionShape::record);
  record.amplitude = 2;
  record.record = laws::Record::make(1, {0, 1, -4, 0});
  EXPECT_DOUBLE_EQ(peaks_of(record, 10)->acceleration, 8);
  EXPECT_DOUBLE_EQ(peaks_of(record, 1)->acceleration, 2);
  EXPECT_DOUBLE_EQ(peaks_of(record, 1)->velocity, 1);
}

TEST(motion_peaks, of_a_function_are_not_known) {
  EXPECT_FALSE(peaks_of(of_type(MotionShape::function), 10));
  EXPECT_FALSE(peaks_of(of_type(MotionShape::record), 10));  // not read
}

/// What is said of a column whose record has these lines.
std::string said_of(const std::string& lines, Real end) {
  const CaseFolder folder;
  folder.write("base.csv", lines);
  return folder
      .read(
          "[case]\ntitle = \"column\"\nmethod = \"mps\"\n[particles]\nspacing = 1.0\ndimension = 2\n[[regions]]\nname = "
          "\"soil\"\n"
          "lower = [0.0, 0.0, 0.0]\nupper = [2.0, 4.0, 0.0]\n[[materials]]\nname = \"soil\"\nregions = [\"soil\"]\ndensity = "
          "1800.0\n"
          "s_wave_velocity = 100.0\np_wave_velocity = 200.0\n[[motions]]\nname = \"base\"\ntype = \"record\"\nfile = "
          "\"base.csv\"\n"
          "[[boundaries]]\nside = \"bottom\"\nkind = \"prescribed\"\nmotion_x = \"base\"\n[time]\nend = " +
          std::to_string(end) + "\nhistory_interval = 0.01\n")
      .warnings;
}

#define EXPECT_SAYS(words, part) EXPECT_NE((words).find(part), std::string::npos) << (words)

TEST(motion_peaks, that_no_earthquake_had_are_told_with_the_unit_that_was_meant) {
  const std::string strong = said_of("time [s],acceleration [m/s2]\n0,0\n1,341.7\n2,-341.7\n3,0\n", 3);
  EXPECT_SAYS(strong, "peak acceleration of 341.7 m/s2, more than any earthquake had");
  EXPECT_SAYS(strong, "as gal it would be 3.417 m/s2");
  EXPECT_SAYS(said_of("time [s],velocity [m/s]\n0,0\n1,34\n2,0\n", 2), "as cm/s it would be 0.34 m/s");
  EXPECT_SAYS(said_of("time [s],acceleration [m/s2]\n0,0\n8,3\n16,3\n", 16), "more than any earthquake did");
  EXPECT_EQ(said_of("time [s],acceleration [m/s2]\n0,0\n1,3.4\n2,-3.4\n3,0\n", 3), "");
}

TEST(motion_peaks, of_a_record_that_ends_before_the_run_come_with_its_drift) {
  const std::string drifts = said_of("time [s],acceleration [m/s2]\n0,0\n1,1\n2,0\n", 4);
  EXPECT_SAYS(drifts, "the record ends at 2 s, before the run at 4 s");
  EXPECT_SAYS(drifts, "goes on at the velocity that is left, 1 m/s, by 2 m to the end of the run");
  EXPECT_SAYS(drifts, "or set baseline = \"linear\"");
  EXPECT_SAYS(said_of("time [s],velocity [m/s]\n0,0\n1,1\n2,0\n", 4), "what it moves stays where it is then");
}

}  // namespace
}  // namespace sazare::cases
