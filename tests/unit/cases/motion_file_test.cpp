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

/// What is said of a record with this name and text.
std::string refused(const std::string& name, const std::string& text) {
  const fs::path file = fs::temp_directory_path() / ("sazare-" + std::to_string(::getpid()) + "-" + name);
  std::ofstream(file) << text;
  Motion motion;
  motion.file = file;
  Problems problems;
  problems.add_source({"case.toml", {}});
  read_motion_file(motion, name, {}, problems);
  fs::remove(file);
  return problems.has_errors() ? problems.error_text() : "nothing";
}

#define EXPECT_SAYS(words, part) EXPECT_NE((words).find(part), std::string::npos) << (words)

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

TEST(motion_file, text_of_any_system_is_read_alike) {
  const std::vector<Real> right = {0, 1, -0.5};
  EXPECT_EQ(read("bom.csv", "\xef\xbb\xbftime [s],acceleration [m/s2]\n0,0\n0.01,1\n0.02,-0.5\n").record.value, right);
  EXPECT_EQ(read("cr.csv", "time [s],acceleration [m/s2]\r0,0\r0.01,1\r0.02,-0.5\r").record.value, right);
  EXPECT_EQ(read("semicolons.csv", "time [s];acceleration [m/s2]\n0;0\n0.01; 1\n0.02;-0.5\n").record.value, right);
  EXPECT_EQ(read("tabs.csv", "time [s]\tacceleration [m/s2]\r\n0\t0\r\n0.01\t1\r\n0.02\t-0.5\r\n").record.value, right);
  const std::string knet = "Sampling Freq(Hz) 100Hz\rDuration Time(s) 0.04\rScale Factor 100(gal)/1\rMemo.\r 10 20\r 30 20\r";
  EXPECT_EQ(read("cr.EW", knet).record.value.size(), 4);
  EXPECT_SAYS(refused("utf16.csv", std::string("\xff\xfet\0i\0m\0e\0", 10)), "is not plain text");
}

TEST(motion_file, a_field_is_one_number_and_nothing_else) {
  const auto row = [](const std::string& text) { return refused("r.csv", "time [s],acceleration [gal]\n0,0\n" + text + "\n"); };
  EXPECT_SAYS(
      row("0.01,1 234"),
      "found \"1 234\"\n    3 | 0.01,1 234\n      |      ^~~~~\n      help: write numbers such as 1.5e-4, without blanks");
  EXPECT_SAYS(row("0.01,1\xc2\xa0" "234"), "a number was expected");
  EXPECT_SAYS(row("0.01,0.5 g"), "found \"0.5 g\"");
  EXPECT_SAYS(row("0.01,,0.5"), "two numbers were expected, found 3");
  EXPECT_SAYS(row("0.01,"), "a number was expected, found \"\"");
  EXPECT_SAYS(row("0.01,1,234"), "two numbers were expected, found 3");
  EXPECT_SAYS(row("0.01;1"), "two numbers were expected, found 1");
  EXPECT_SAYS(row("0.01,+-1"), "a number was expected");
  EXPECT_SAYS(refused("r.csv", "time [s];acceleration [gal]\n0;0\n0,01;1,5\n"), "write a decimal point");
  EXPECT_SAYS(refused("r.csv", "time [s]\tacceleration [gal]\n0\t0\n0.01\t1,5\n"), "write a decimal point");
}

TEST(motion_file, units_are_read_as_they_stand) {
  const auto peer = [](const std::string& units, const std::string& counts = "NPTS= 2, DT= .01 SEC") {
    return "PEER\nevent\n" + units + "\n" + counts + "\n 1.0 -2.0\n";
  };
  EXPECT_DOUBLE_EQ(read("a.AT2", peer("ACCELERATION TIME HISTORY IN UNITS OF GAL")).record.value[1], -0.02);
  EXPECT_DOUBLE_EQ(read("a.AT2", peer("ACCELERATION IN UNITS OF CM/SEC/SEC")).record.value[1], -0.02);
  EXPECT_DOUBLE_EQ(read("a.AT2", peer("ACCELERATION IN UNITS OF G. FILTER POINTS: HP=0.1 Hz")).record.value[1], -2 * 9.80665);
  for (const char* units :
       {"UNITS OF G/10", "UNITS OF MG", "UNITS OF G * 10", "UNITS OF CM/SEC", "UNITS OF", "VELOCITY IN UNITS OF G"})
    EXPECT_SAYS(refused("a.AT2", peer(units)), "is not a unit of acceleration");
  EXPECT_SAYS(refused("a.AT2", peer("UNITS OF G", "NPTS= 2, DT= 10 MSEC")), "DT is given in \"MSEC\"");
}

TEST(motion_file, a_file_holds_what_its_header_announces) {
  const auto knet = [](const std::string& duration, const std::string& scale) {
    return "Sampling Freq(Hz) 100Hz\nDuration Time(s) " + duration + "\nScale Factor " + scale + "\nMemo.\n 10 20 30 20\n";
  };
  EXPECT_EQ(read("a.EW", knet("0.04", "100(gal)/1")).record.value.size(), 4);
  EXPECT_SAYS(refused("a.EW", knet("60", "100(gal)/1")), "announces 60 s at 100 Hz, 6000 samples, but 4 follow");
  EXPECT_SAYS(refused("a.EW", knet("0.03", "100(gal)/1")), "3 samples, but 4 follow");
  for (const char* scale : {"100(gal)/0", "100(cm)/1", "100/1", "(gal)/1", "100(gal)/1 x"})
    EXPECT_SAYS(refused("a.EW", knet("0.04", scale)), "there is no scale factor in gal");
  const auto peer = [](const std::string& count) {
    return "PEER\nevent\nUNITS OF G\nNPTS= " + count + ", DT= .01 SEC\n 1.0 -2.0\n";
  };
  EXPECT_SAYS(refused("a.AT2", peer("99999999999999999999999999")), "NPTS is 99999999999999999999999999, but 2 values follow");
  EXPECT_SAYS(refused("a.AT2", peer("3")), "NPTS is 3, but 2 values follow");
}

TEST(motion_file, numbers_beyond_any_motion_are_refused) {
  EXPECT_SAYS(refused("a.csv", "time [s],acceleration [g]\n0,1e308\n0.01,1\n"), "acceleration: 1e308 is beyond any motion");
}

TEST(motion_file, long_lines_are_scanned_in_linear_time) {
  const std::string ones(200000, '1'), blanks(200000, ' ');
  EXPECT_SAYS(refused("a.AT2", "PEER\nevent\nUNITS OF G\nNPTS= " + ones + ", DT= .01\n 1 2\n"), "NPTS is 1");
  EXPECT_SAYS(refused("a.AT2", "PEER\nevent\nUNITS OF G\nNPTS" + blanks + "x\n 1 2\n"), "gives NPTS and DT");
  EXPECT_SAYS(refused("a.csv", "time [s],acceleration [" + ones + "]\n0,1\n1,2\n"), "is not a unit of acceleration");
  EXPECT_SAYS(refused("a.csv", blanks + "x\n0,1\n1,2\n"), "wrong header");
  EXPECT_SAYS(refused("a.EW", "Sampling Freq(Hz)" + blanks + "1\nMemo.\n1 2\n"), "sampling frequency is missing");
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
