#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sazare/core/error.hpp"
#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/levels/terms/energy_balance.hpp"
#include "sazare/runs/record_columns.hpp"
#include "sazare/runs/record_files.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

using test::read_text;

std::vector<RecordFiles::Table> two_tables(const std::filesystem::path& folder) {
  return {{folder / "history.csv", {"time [s]"}}, {folder / "gauges.csv", {"time [s]", "speed [m/s]"}}};
}

void add_rows(RecordFiles& files, std::initializer_list<Real> times) {
  for (const Real time : times) {
    files.add_row(0, std::vector<Real>{time});
    files.add_row(1, std::vector<Real>{time, 2 * time});
  }
}

TEST(RecordFiles, RefusesARowThatIsNoNumber) {
  const test::TemporaryFolder folder;
  RecordFiles files(folder.path() / "snapshots", "cells");
  files.begin(two_tables(folder.path()));
  add_rows(files, {0});
  const auto words = [&](Real value) {
    return test::words_of<PhysicsError>([&] { files.add_row(1, std::vector<Real>{0.5, value}); });
  };
  EXPECT_TRUE(words(std::nan("")).starts_with("gauges.csv: \"speed [m/s]\" is not a number where \"time [s]\" is 0.5\n")) << words(std::nan(""));
  EXPECT_TRUE(words(-std::numeric_limits<Real>::infinity()).starts_with("gauges.csv: \"speed [m/s]\" is infinite where \"time [s]\" is 0.5\n"));
  files.flush(false);
  EXPECT_EQ(read_text(folder.path() / "gauges.csv"), "time [s],speed [m/s]\n0,0\n");
}

TEST(RecordFiles, RefusesTwoColumnsOfOneName) {
  const test::TemporaryFolder folder;
  RecordFiles files(folder.path() / "snapshots", "cells");
  const std::string words = test::words_of<UserError>(
      [&] { files.begin({{folder.path() / "history.csv", {"time [s]", "support.force_x [N]", "support.force_x [N]"}}}); });
  EXPECT_NE(words.find("two columns would be called \"support.force_x [N]\""), std::string::npos) << words;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "history.csv"));
}

TEST(RecordFiles, GoesOnWithWhatItsCheckpointCountsOn) {
  const test::TemporaryFolder folder;
  const auto checkpoint = folder.path() / "state.h5";
  {
    RecordFiles files(folder.path() / "snapshots", "cells");
    files.begin(two_tables(folder.path()));
    add_rows(files, {0, 1});
    observe::CheckpointWriter out(checkpoint);
    CheckpointSaver saver(out);
    files.columns(saver);
    out.commit();
    add_rows(files, {2, 3});  // after the checkpoint: done again by the resumed run
  }
  RecordFiles files(folder.path() / "snapshots", "cells");
  const observe::CheckpointReader in(checkpoint);
  CheckpointLoader loader(in);
  files.columns(loader);
  std::filesystem::create_directories(folder.path() / "snapshots");
  files.resume(two_tables(folder.path()));
  EXPECT_EQ(files.rows(), 2U);
  add_rows(files, {5});
  files.flush(false);
  EXPECT_EQ(read_text(folder.path() / "history.csv"), "time [s]\n0\n1\n5\n");
  EXPECT_EQ(read_text(folder.path() / "gauges.csv"), "time [s],speed [m/s]\n0,0\n1,2\n5,10\n");
}

TEST(RecordColumns, EveryTermOfTheEnergyBalanceHasItsColumn) {
  const auto name = [](terms::EnergyKind account) { return columns::blocks::energies[static_cast<std::size_t>(account)].name; };
  EXPECT_EQ(name(terms::EnergyKind::work), "energy_work");
  EXPECT_EQ(name(terms::EnergyKind::kinetic), "energy_kinetic");
  EXPECT_EQ(name(terms::EnergyKind::joint_dashpot), "energy_joint_dashpot");
  EXPECT_EQ(name(terms::EnergyKind::fracture), "energy_fracture");
  EXPECT_EQ(name(terms::EnergyKind::release), "energy_release");
  EXPECT_EQ(name(terms::EnergyKind::friction), "energy_friction");
  EXPECT_EQ(name(terms::EnergyKind::boundary), "energy_boundary_dashpot");
}

}  // namespace
}  // namespace sazare::runs
