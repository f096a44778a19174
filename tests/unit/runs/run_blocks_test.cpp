#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sazare/core/error.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::block_case, test::read_manifest, test::read_text, test::run_quietly, test::TemporaryFolder;

std::vector<std::string> keys_of(const nlohmann::json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  std::ranges::sort(keys);
  return keys;
}

std::string first_line(const fs::path& file) {
  const std::string text = read_text(file);
  return text.substr(0, text.find('\n'));
}

std::size_t lines_of(const fs::path& file) {
  const std::string text = read_text(file);
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// One run for all tests that only look at what it left.
class FinishedRun : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    outcome = new RunOutcome(run_quietly(block_case(), *folder / "run"));
  }
  static void TearDownTestSuite() {
    delete outcome;
    delete folder;
  }
  static fs::path run() { return *folder / "run"; }

  static TemporaryFolder* folder;
  static RunOutcome* outcome;
};

TemporaryFolder* FinishedRun::folder = nullptr;
RunOutcome* FinishedRun::outcome = nullptr;

/// Scripts of users read these names.
TEST_F(FinishedRun, ManifestHasTheNamesOfTheInterface) {
  const nlohmann::json manifest = read_manifest(run());
  EXPECT_EQ(keys_of(manifest), (std::vector<std::string>{"case", "commit", "finished", "machine", "method", "results", "sazare",
                                                         "started", "state_hash", "status"}));
  EXPECT_EQ(keys_of(manifest["machine"]), (std::vector<std::string>{"cores", "cpu", "ranks", "threads"}));
  EXPECT_EQ(keys_of(manifest["results"]), (std::vector<std::string>{"broken_in_shear",
                                                                    "broken_joints",
                                                                    "detached_fragments",
                                                                    "detached_volume",
                                                                    "elements",
                                                                    "energy_boundary_dashpot",
                                                                    "energy_contact_dashpot",
                                                                    "energy_elastic",
                                                                    "energy_fracture",
                                                                    "energy_friction",
                                                                    "energy_joint_dashpot",
                                                                    "energy_kinetic",
                                                                    "energy_release",
                                                                    "energy_residual",
                                                                    "energy_slip",
                                                                    "energy_work",
                                                                    "fragments",
                                                                    "joints",
                                                                    "largest_fragment_volume",
                                                                    "p20",
                                                                    "p50",
                                                                    "p80",
                                                                    "pair_evaluations",
                                                                    "peak_speed",
                                                                    "ppv",
                                                                    "smallest_step",
                                                                    "steps",
                                                                    "throw_max",
                                                                    "uniform_evaluations",
                                                                    "update_times",
                                                                    "updates",
                                                                    "wall_seconds"}));
  EXPECT_EQ(keys_of(manifest["results"]["ppv"]), (std::vector<std::string>{"G1", "G2"}));
  EXPECT_EQ(manifest["status"], "done");
  EXPECT_EQ(manifest["case"], "Small block");
  EXPECT_EQ(manifest["method"], "blocks");
}

TEST_F(FinishedRun, FiguresBelongToABlockThatBreaks) {
  const nlohmann::json results = read_manifest(run())["results"];
  EXPECT_GT(results["broken_joints"], 0);
  EXPECT_GT(results["energy_work"], 0);
  EXPECT_LT(std::abs(results["energy_residual"].get<Real>()), 1e-2 * results["energy_work"].get<Real>());
  EXPECT_GT(results["ppv"]["G1"], 0);
  EXPECT_GE(results["peak_speed"], results["ppv"]["G1"]);
  EXPECT_GT(results["p20"], 0);
  EXPECT_GE(results["p50"], results["p20"]);
  EXPECT_GE(results["p80"], results["p50"]);
  EXPECT_GT(results["detached_volume"], 0);
  EXPECT_LE(results["detached_fragments"], results["fragments"]);
  EXPECT_GT(results["steps"], 0);
}

TEST_F(FinishedRun, TablesHaveUnitsInTheirHeadersAndARowForEveryInterval) {
  EXPECT_EQ(first_line(run() / "history.csv"),
            "time [s],broken_joints [-],fragments [-],energy_work [J],energy_kinetic [J],energy_elastic "
            "[J],energy_joint_dashpot [J],energy_slip [J],energy_fracture [J],energy_release [J],energy_contact_dashpot "
            "[J],energy_friction [J],energy_boundary_dashpot [J],energy_residual [J],smallest_step [s],pair_evaluations "
            "[-],wall_seconds [s]");
  EXPECT_EQ(first_line(run() / "gauges.csv"),
            "time [s],G1.velocity_x [m/s],G1.velocity_y [m/s],G1.velocity_z [m/s],G2.velocity_x [m/s],G2.velocity_y "
            "[m/s],G2.velocity_z [m/s]");
  EXPECT_EQ(first_line(run() / "fragments.csv"),
            "fragment [-],elements [-],volume [m3],mass [kg],size [m],center_x [m],center_y [m],center_z [m],velocity_x "
            "[m/s],velocity_y [m/s],velocity_z [m/s],throw [m],stays [-]");
  EXPECT_EQ(first_line(run() / "gauge_peaks.csv"),
            "gauge,point_x [m],point_y [m],point_z [m],ppv [m/s],time [s],peak_x [m/s],peak_y [m/s],peak_z [m/s]");
  EXPECT_EQ(first_line(run() / "holes.csv"),
            "hole,delay [s],first_x [m],first_y [m],first_z [m],last_x [m],last_y [m],last_z [m],diameter [m],mass [kg]");
  EXPECT_EQ(lines_of(run() / "gauge_peaks.csv"), 3u);
  EXPECT_EQ(lines_of(run() / "holes.csv"), 1u);  // the pressure acts on a flat face
  EXPECT_EQ(first_line(run() / "half_casts.csv"),
            "hole,first_x [m],first_y [m],first_z [m],last_x [m],last_y [m],last_z [m],length [m],half_cast [m],whole "
            "[m],standing [-]");
  EXPECT_EQ(lines_of(run() / "half_casts.csv"), 1u);
  EXPECT_FALSE(read_manifest(run())["results"].contains("half_cast_factor"));
  EXPECT_EQ(first_line(run() / "timing.csv"), "part,seconds [s],share [-]");
  EXPECT_EQ(lines_of(run() / "history.csv"), 102u);
  EXPECT_EQ(lines_of(run() / "gauges.csv"), 102u);
  EXPECT_EQ(lines_of(run() / "fragments.csv"), 1 + read_manifest(run())["results"]["fragments"].get<std::size_t>());
}

TEST_F(FinishedRun, LeavesSnapshotsAndNoCheckpoint) {
  for (const char* name : {"elements_00000.vtkhdf", "elements_00002.vtkhdf", "joints_00002.vtkhdf", "elements.vtkhdf.series",
                           "joints.vtkhdf.series"})
    EXPECT_TRUE(fs::exists(run() / "snapshots" / name)) << name;
  EXPECT_FALSE(fs::exists(run() / "snapshots/elements_00003.vtkhdf"));
  EXPECT_FALSE(fs::exists(run() / "checkpoint"));
}

TEST_F(FinishedRun, ItsResolvedCaseGivesTheSameRun) {
  const TemporaryFolder other;
  const cases::CaseFile resolved = registry::read_case(run() / "case.toml");
  EXPECT_EQ(run_quietly(resolved, other / "run").manifest.state_hash, outcome->manifest.state_hash);
}

TEST_F(FinishedRun, IsTheSameOnAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3, 4}) {
    const TemporaryFolder other;
    parallel::set_threads(threads);
    EXPECT_EQ(run_quietly(block_case(), other / "run").manifest.state_hash, outcome->manifest.state_hash) << threads;
    EXPECT_EQ(read_text(other / "run/gauge_peaks.csv"), read_text(run() / "gauge_peaks.csv")) << threads;
  }
  parallel::set_threads(0);
}

TEST_F(FinishedRun, IsNotDisturbedByBeingObserved) {
  const TemporaryFolder other;
  const std::string base_step = "time.base_step=1e-7";
  const auto often = run_quietly(block_case({base_step}), other / "often");
  const auto seldom =
      run_quietly(block_case({base_step, "time.history_interval=2e-5", "output.checkpoint_interval=0.01"}), other / "seldom");
  EXPECT_EQ(often.manifest.state_hash, seldom.manifest.state_hash);
  EXPECT_EQ(often.manifest.peak_particle_velocity, seldom.manifest.peak_particle_velocity);
  EXPECT_EQ(read_text(other / "often/gauge_peaks.csv"), read_text(other / "seldom/gauge_peaks.csv"));
}

TEST(RunBlocks, WalkedInPartsAndLookedAtItHasTheBitsOfOneRun) {
  const TemporaryFolder folder;
  const cases::CaseFile file = block_case();
  const auto whole = run_quietly(file, folder / "whole");
  const auto run = registry::open_case(file, {folder / "parts", Begin::fresh, true});
  run->begin();
  MotionTable table;
  int pauses = 0;
  while (!run->is_over()) {
    run->walk(run->step() + 7, [&] { return ++pauses % 5 == 0; });
    const Vector3* before = table.position.data();
    run->read_motion(table);
    EXPECT_TRUE(before == nullptr || before == table.position.data());
  }
  EXPECT_EQ(run->time(), run->clocks().end);
  const RunOutcome outcome = run->finish();
  EXPECT_FALSE(outcome.stopped);
  EXPECT_EQ(outcome.manifest.state_hash, whole.manifest.state_hash);
  EXPECT_EQ(table.force.size(), table.velocity.size());
}

TEST(RunBlocks, AMotionThatMakesNoSenseEndsTheRunAndKeepsTheCheckpoint) {
  const TemporaryFolder folder;
  const cases::CaseFile absurd = block_case(
      {"time.limiter=none", "time.base_step=2e-5", "time.history_interval=2e-5", "time.end=1e-3", "time.snapshot_interval=1e-3"});
  const std::string words = test::words_of<PhysicsError>([&] { run_quietly(absurd, folder / "run"); });
  EXPECT_TRUE(words.starts_with("element ")) << words;
  EXPECT_NE(words.find("farther in one step than its own size, found at t = "), std::string::npos) << words;
  EXPECT_NE(words.find("times the stability limit ("), std::string::npos) << words;
  EXPECT_NE(words.find(" s) from the dashpots of its joints and boundaries: "), std::string::npos) << words;
  EXPECT_NE(words.find("set time.limiter = \"stability\", or time.base_step to "), std::string::npos) << words;
  EXPECT_NE(words.find("the checkpoint of t = 0 s is kept in "), std::string::npos) << words;
  EXPECT_TRUE(fs::exists(folder / "run/checkpoint/state.h5"));
  EXPECT_EQ(read_manifest(folder / "run")["status"], "failed");
}

/// Where the levels are refined while bodies fly apart, the step that began it is named all the same.
TEST(RunBlocks, AStepFarAboveTheLimitIsNamedThoughTheElementHasAShortOneByThen) {
  const TemporaryFolder folder;
  const cases::CaseFile absurd = block_case({"time.limiter=travel", "time.base_step=2e-5", "time.history_interval=2e-5", "time.end=1e-3",
                                             "time.snapshot_interval=1e-3"});
  const std::string words = test::words_of<PhysicsError>([&] { run_quietly(absurd, folder / "run"); });
  EXPECT_NE(words.find("the step may be 20e-6 s long, which is "), std::string::npos) << words;
  EXPECT_NE(words.find("set time.limiter = \"stability\", or time.base_step to "), std::string::npos) << words;
  EXPECT_EQ(words.find("check the loads"), std::string::npos) << words;
}

}  // namespace
}  // namespace sazare::runs
