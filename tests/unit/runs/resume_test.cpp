#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include "sazare/core/error.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;
using test::block_case, test::read_manifest, test::read_text, test::run_in_parts, test::run_quietly, test::run_whole,
    test::TemporaryFolder;

std::string words_of_resuming(const cases::CaseFile& file, const fs::path& folder) {
  return test::words_of<UserError>([&] { run_quietly(file, folder, Begin::resume); });
}

/// A run that was asked to stop before its first step.
void stop_at_once(const cases::CaseFile& file, const fs::path& folder) {
  const std::atomic<bool> stop = true;
  EXPECT_TRUE(run_quietly(file, folder, Begin::fresh, &stop).stopped);
}

TEST(Resume, InManyPartsGivesTheBitsOfOneRun) {
  const TemporaryFolder folder;
  const cases::CaseFile file = block_case({"time.end=4e-4"});
  run_in_parts(file, folder / "parts", run_whole(file, folder / "whole"));
  const nlohmann::json one = read_manifest(folder / "whole"), many = read_manifest(folder / "parts");
  EXPECT_EQ(one["state_hash"], many["state_hash"]);
  for (const auto& [name, value] : one["results"].items())
    if (name != "wall_seconds") {
      EXPECT_EQ(value, many["results"][name]) << name;
    }
  EXPECT_EQ(test::without_last_column(read_text(folder / "whole/history.csv")),
            test::without_last_column(read_text(folder / "parts/history.csv")));
  for (const char* table : {"gauges.csv", "gauge_peaks.csv", "fragments.csv"})
    EXPECT_EQ(read_text(folder / "whole" / table), read_text(folder / "parts" / table)) << table;
  EXPECT_EQ(read_text(folder / "whole/snapshots/elements.vtkhdf.series"),
            read_text(folder / "parts/snapshots/elements.vtkhdf.series"));
}

TEST(Resume, WithoutARunBeginsOne) {
  const TemporaryFolder folder;
  EXPECT_FALSE(run_quietly(block_case(), folder / "run", Begin::resume).stopped);
}

TEST(Resume, OfAnotherCaseIsRefusedWithWhatHasChanged) {
  const TemporaryFolder folder;
  stop_at_once(block_case(), folder / "run");
  const std::string words = words_of_resuming(block_case({"joints.0.cohesion=7e6"}), folder / "run");
  EXPECT_NE(words.find("cannot be resumed: the case is not the one that the checkpoint was written for"), std::string::npos)
      << words;
  EXPECT_NE(words.find("checkpoint: cohesion = 6.66e6"), std::string::npos) << words;
  EXPECT_NE(words.find("now: cohesion = 7e6"), std::string::npos) << words;
  EXPECT_EQ(read_manifest(folder / "run")["status"], "stopped");
}

TEST(Resume, OnAnotherMeshIsRefused) {
  const TemporaryFolder folder;
  fs::copy("tests/regression/block/case.toml", folder / "case.toml");
  fs::copy("tests/regression/block/block.msh", folder / "block.msh");
  const std::vector<std::string> settings = {"time.end=4e-5"};
  stop_at_once(registry::read_case(folder / "case.toml", settings), folder / "run");
  std::string mesh = read_text(folder / "block.msh");
  const std::size_t corner = mesh.find("\n0.4 0.3 0.3\n");
  ASSERT_NE(corner, std::string::npos);
  std::ofstream(folder / "block.msh") << mesh.replace(corner, 13, "\n0.4 0.3 0.31\n");
  const std::string words = words_of_resuming(registry::read_case(folder / "case.toml", settings), folder / "run");
  EXPECT_NE(words.find("the mesh is not the one that the checkpoint was written for"), std::string::npos) << words;
}

TEST(Resume, MayChangeHowOftenACheckpointIsWritten) {
  const TemporaryFolder folder;
  stop_at_once(block_case(), folder / "run");
  EXPECT_FALSE(run_quietly(block_case({"output.checkpoint_interval=5"}), folder / "run", Begin::resume).stopped);
}

TEST(Resume, OfADamagedCheckpointIsRefused) {
  const TemporaryFolder folder;
  stop_at_once(block_case(), folder / "run");
  fs::resize_file(folder / "run/checkpoint/state.h5", 1000);
  EXPECT_NE(words_of_resuming(block_case(), folder / "run"), "");
}

TEST(Resume, OfADoneRunIsRefused) {
  const TemporaryFolder folder;
  run_quietly(block_case(), folder / "run");
  EXPECT_NE(words_of_resuming(block_case(), folder / "run").find("is complete, there is nothing to resume"), std::string::npos);
}

}  // namespace
}  // namespace sazare::runs
