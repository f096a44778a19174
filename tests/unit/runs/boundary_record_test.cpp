#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "tests/unit/runs/support.hpp"

/// What runs of blocks write of their boundaries and gauges, against what is known of it.
namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::read_manifest, test::read_text, test::TemporaryFolder;

/// The small block of tests/regression with other tables instead of its blast; its surfaces are "hole" and "far".
cases::CaseFile block_with(const fs::path& folder, const std::string& tables, const std::vector<std::string>& settings) {
  std::string text = read_text("tests/regression/block/case.toml");
  const std::size_t blast = text.find("[[blasts]]"), gauges = text.find("[[gauges]]");
  text.replace(blast, gauges - blast, tables);
  text.replace(text.find("block.msh"), 9, fs::absolute("tests/regression/block/block.msh").string());
  std::ofstream(folder / "case.toml") << text;
  return registry::read_case(folder / "case.toml", settings);
}

/// The columns of a table of numbers, by their titles.
std::map<std::string, std::vector<Real>> columns_of(const fs::path& file) {
  std::istringstream lines(read_text(file));
  std::string line, word;
  std::getline(lines, line);
  std::vector<std::string> titles;
  for (std::istringstream head(line); std::getline(head, word, ',');) titles.push_back(word);
  std::map<std::string, std::vector<Real>> columns;
  while (std::getline(lines, line)) {
    std::istringstream row(line);
    for (const std::string& title : titles) {
      std::getline(row, word, ',');
      columns[title].push_back(std::stod(word));
    }
  }
  return columns;
}

/// Ground that moves with V/2 (1 - cos(2 pi t / T)): its largest velocity is V, at T/2.
constexpr Real fastest = 0.02, period = 1e-2;

Real peak_on_moving_ground(const TemporaryFolder& folder, const std::string& interval) {
  std::ofstream record(folder / "ground.csv");
  record.precision(15);
  record << "time [s],velocity [m/s]\n";
  for (int i = 0; i <= 1000; ++i)
    record << i * period / 1000 << "," << 0.5 * fastest * (1 - std::cos(2 * std::numbers::pi * i / 1000)) << "\n";
  record.close();
  const cases::CaseFile file = block_with(
      folder.path(),
      "[[motions]]\nname = \"ground\"\ntype = \"record\"\nfile = \"ground.csv\"\n"
      "[[boundaries]]\nsurface = \"hole\"\nkind = \"prescribed\"\nmotion_z = \"ground\"\n",
      {"time.end=7.5e-3", "time.base_step=1e-6", "time.history_interval=" + interval, "time.snapshot_interval=7.5e-3"});
  test::run_quietly(file, folder / interval);
  return read_manifest(folder / interval)["results"]["ppv"]["G1"].get<Real>();
}

/// The block follows ground of 100 Hz as a whole: the lowest frequency at which it swings on its own is some thirty times as
/// high, so that it moves by one part in a thousand more.
TEST(GaugePeaks, OfASineAreThoseOfTheSineHoweverSeldomARowIsWritten) {
  const TemporaryFolder folder;
  const Real often = peak_on_moving_ground(folder, "1e-6"), seldom = peak_on_moving_ground(folder, "3.75e-3");
  EXPECT_NEAR(often, fastest, 0.01 * fastest);
  EXPECT_EQ(often, seldom);
  Real of_rows = 0;  // at 0, 3.75 and 7.5 ms
  const auto columns = columns_of(folder / "3.75e-3/gauges.csv");
  for (const Real velocity : columns.at("G1.velocity_z [m/s]")) of_rows = std::max(of_rows, std::abs(velocity));
  EXPECT_NEAR(of_rows, 0.5 * fastest * (1 - std::cos(0.75 * std::numbers::pi)), 0.01 * fastest);
  EXPECT_LT(of_rows, 0.9 * seldom);
}

TEST(BoundaryEnergy, OfAllBoundariesIsThatOfTheBalance) {
  const TemporaryFolder folder;
  const cases::CaseFile file =
      block_with(folder.path(),
                 "[[blasts]]\nsurface = \"hole\"\npeak_pressure = 5e7\nrise_time = 2e-5\ndecay_ratio = 2.0\n"
                 "[[boundaries]]\nsurface = \"far\"\nkind = \"absorbing\"\n",
                 {"time.end=1e-4", "time.snapshot_interval=1e-4"});
  test::run_quietly(file, folder / "run");
  auto columns = columns_of(folder / "run/history.csv");
  const std::vector<Real>&absorbed = columns["far.absorbed [J]"], &balance = columns["energy_boundary_dashpot [J]"];
  ASSERT_FALSE(absorbed.empty());
  EXPECT_GT(balance.back(), 0);
  for (std::size_t row = 0; row < absorbed.size(); ++row) EXPECT_NEAR(absorbed[row], balance[row], 1e-12 * balance.back()) << row;
}

TEST(BoundaryEnergy, CountsThatOfMovingGround) {
  const TemporaryFolder folder;
  std::ofstream(folder / "ground.csv") << "time [s],velocity [m/s]\n0,0\n2e-5,0.1\n4e-5,0\n";
  const cases::CaseFile file = block_with(folder.path(),
                                          "[[motions]]\nname = \"ground\"\ntype = \"record\"\nfile = \"ground.csv\"\n"
                                          "[[boundaries]]\nsurface = \"hole\"\nkind = \"absorbing\"\nmotion_z = \"ground\"\n"
                                          "[[boundaries]]\nsurface = \"far\"\nkind = \"absorbing\"\n",
                                          {"time.end=1e-4", "time.snapshot_interval=1e-4"});
  test::run_quietly(file, folder / "run");
  auto columns = columns_of(folder / "run/history.csv");
  const std::vector<Real>& balance = columns["energy_boundary_dashpot [J]"];
  ASSERT_GT(balance.back(), 0);
  EXPECT_GT(columns["hole.absorbed [J]"].back(), 0);
  EXPECT_GT(columns["far.absorbed [J]"].back(), 0);
  for (std::size_t row = 0; row < balance.size(); ++row)
    EXPECT_NEAR(columns["hole.absorbed [J]"][row] + columns["far.absorbed [J]"][row], balance[row], 1e-12 * balance.back())
        << row;
}

}  // namespace
}  // namespace sazare::runs
