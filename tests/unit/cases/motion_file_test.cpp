#include "sazare/cases/motion_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace sazare::cases {
namespace {

namespace fs = std::filesystem;

/// Reads a record with this name and text; no problem may be found.
Motion read(const std::string& name, const std::string& text) {
  const fs::path file = fs::temp_directory_path() / ("sazare-" + std::to_string(::getpid()) + "-" + name);
  std::ofstream(file) << text;
  Motion motion;
  motion.file = file;
  Problems problems;
  problems.add_source({"case.toml", {}});
  read_motion_file(motion, name, {}, problems);
  EXPECT_FALSE(problems.has_errors()) << problems.error_text();
  fs::remove(file);
  return motion;
}

TEST(motion_file, csv_is_taken_in_the_unit_of_its_header) {
  const Motion gal = read("a.csv", "time [s],acceleration [gal]\n0,0\n0.01, 100 \n0.02,-50\n");
  EXPECT_EQ(gal.quantity, laws::MotionQuantity::acceleration);
  EXPECT_DOUBLE_EQ(gal.record.step, 0.01);
  EXPECT_EQ(gal.record.value, (std::vector<Real>{0, 1, -0.5}));
  const Motion velocity = read("b.csv", "time [s],velocity [cm/s]\r\n0,0\r\n0.5,20\r\n");
  EXPECT_EQ(velocity.quantity, laws::MotionQuantity::velocity);
  EXPECT_DOUBLE_EQ(velocity.record.value.back(), 0.2);
  EXPECT_DOUBLE_EQ(read("c.csv", "time [s],acceleration [g]\n0,0\n1,1\n").record.value.back(), 9.80665);
}

TEST(motion_file, peer_record) {
  const Motion motion = read(
      "a.AT2", "PEER\nevent\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS=  3, DT= .0050 SEC\n  .1E+00 -2.0E-01\n  3.0E-01\n");
  EXPECT_DOUBLE_EQ(motion.record.step, 0.005);
  ASSERT_EQ(motion.record.value.size(), 3);
  EXPECT_DOUBLE_EQ(motion.record.value[1], -0.2 * 9.80665);
}

TEST(motion_file, knet_record_in_counts_about_its_mean) {
  const Motion motion =
      read("a.EW",
           "Origin Time       2011/03/11 14:46:00\nSampling Freq(Hz) 100Hz\nScale Factor      3920(gal)/6182761\n"
           "Max. Acc. (gal)   1.0\nMemo.\n   1000   1200   800   1000\n");
  EXPECT_DOUBLE_EQ(motion.record.step, 0.01);
  ASSERT_EQ(motion.record.value.size(), 4);
  EXPECT_NEAR(motion.record.value[1], 200 * 0.01 * 3920 / 6182761, 1e-15);
  EXPECT_NEAR(motion.record.value[0], 0, 1e-15);
}

TEST(motion_file, el_centro_has_its_peak) {
  Motion motion;
  motion.file = "cases/soil-column-el-centro/el-centro-1940-ns.AT2";
  Problems problems;
  read_motion_file(motion, "el-centro", {}, problems);
  ASSERT_EQ(motion.record.value.size(), 1560);
  Real peak = 0;
  for (const Real value : motion.record.value) peak = std::max(peak, std::abs(value));
  EXPECT_NEAR(peak, 0.31882 * 9.80665, 1e-4);
}

}  // namespace
}  // namespace sazare::cases
