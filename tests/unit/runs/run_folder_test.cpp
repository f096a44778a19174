#include "sazare/runs/run_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>

#include "sazare/core/error.hpp"
#include "tests/unit/runs/support.hpp"

namespace sazare::runs {
namespace {

namespace fs = std::filesystem;

std::string words_of_opening(const fs::path& folder, Begin begin) {
  return test::words_of<UserError>([&] { RunFolder(folder, begin); });
}

/// What is said to opening the folder of a run of this status.
std::string refusal(const fs::path& run, const std::string& status, Begin begin) {
  sazare::test::write_text(run / "manifest.json", R"({"status": ")" + status + R"("})");
  return words_of_opening(run, begin);
}

TEST(RunFolder, IsMade) {
  const test::TemporaryFolder folder;
  const RunFolder made(folder / "a/b", Begin::fresh);
  EXPECT_TRUE(fs::is_directory(folder / "a/b"));
  EXPECT_FALSE(made.resumes());
}

TEST(RunFolder, WithOtherFilesIsTaken) {
  const test::TemporaryFolder folder;
  sazare::test::write_text(folder / "run/notes.txt", "mine");
  EXPECT_EQ(words_of_opening(folder / "run", Begin::fresh), "");
}

TEST(RunFolder, WithARunIsNotOverwrittenInSilence) {
  const test::TemporaryFolder folder;
  const fs::path run = folder / "run";
  EXPECT_EQ(refusal(run, "running", Begin::fresh),
            run.string() +
                ": this folder already contains a run, which is not complete. Use --resume to continue it, "
                "--overwrite to replace it, or another folder (--out)");
  EXPECT_EQ(refusal(run, "done", Begin::fresh),
            run.string() +
                ": this folder already contains a run, which is complete. Use --overwrite to replace it, or "
                "another folder (--out)");
}

TEST(RunFolder, WithADoneRunIsNotResumed) {
  const test::TemporaryFolder folder;
  const fs::path run = folder / "run";
  EXPECT_EQ(refusal(run, "done", Begin::resume),
            run.string() +
                ": the run in this folder is complete, there is nothing to resume. Its figures are in manifest.json; "
                "use --overwrite to run the case again");
}

TEST(RunFolder, ARunThatIsToBeReplacedStandsUntilTheNewOneBegins) {
  const test::TemporaryFolder folder;
  const fs::path run = folder / "run";
  sazare::test::write_text(run / "manifest.json", "old");
  sazare::test::write_text(run / "checkpoint/state.h5", "old");
  sazare::test::write_text(run / "mesh.msh", "old");
  sazare::test::write_text(run / "mesh.new.msh", "of a run that could not begin");
  RunFolder opened(run, Begin::overwrite);
  EXPECT_FALSE(fs::exists(opened.mesh()));
  sazare::test::write_text(opened.mesh(), "new");
  EXPECT_EQ(test::read_text(run / "mesh.msh"), "old");
  EXPECT_TRUE(fs::exists(run / "manifest.json") && fs::exists(opened.checkpoint()));
  opened.clear();
  EXPECT_EQ(test::read_text(run / "mesh.msh"), "new");
  EXPECT_EQ(opened.mesh(), run / "mesh.msh");
  EXPECT_FALSE(fs::exists(run / "manifest.json") || fs::exists(opened.checkpoint()) || fs::exists(run / "mesh.new.msh"));
  EXPECT_TRUE(fs::exists(opened.checkpoint().parent_path()));
}

TEST(RunFolder, OverwritingRemovesTheRunAndNothingElse) {
  const test::TemporaryFolder folder;
  const fs::path run = folder / "run";
  for (const char* name : {"manifest.json", "history.csv", "checkpoint/state.h5", "snapshots/elements_00007.vtkhdf",
                           "snapshots/.joints_00007.vtkhdf.part", "snapshots/elements.vtkhdf.series", "report.html",
                           "ground_motion.csv", "profiles.csv", "report/energy.png"})
    sazare::test::write_text(run / name, "old");
  sazare::test::write_text(run / "notes.txt", "mine");
  sazare::test::write_text(run / "snapshots/picture.png", "mine");
  RunFolder(run, Begin::overwrite).clear();
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(run))
    if (entry.is_regular_file()) left.push_back(entry.path().filename().string());
  std::ranges::sort(left);
  EXPECT_EQ(left, (std::vector<std::string>{"notes.txt", "picture.png"}));
}

TEST(RunFolder, SnapshotsOfEveryMethodAndTheSidesOfACoupledRunGoWithIt) {
  const test::TemporaryFolder folder;
  const fs::path run = folder / "run";
  for (const char* name :
       {"manifest.json", "snapshots/rectangles_00000.vtkhdf", "snapshots/rectangles.hdf.series", "bodies/history.csv",
        "bodies/snapshots/rectangles_00001.vtkhdf", "bodies/snapshots/particles.vtkhdf.series", "continuum/case.toml",
        "continuum/snapshots/finite_elements_00000.vtkhdf"})
    sazare::test::write_text(run / name, "old");
  for (const char* name : {"bodies/notes.txt", "snapshots/particles_mine.vtkhdf", "snapshots/elements.vtkhdf"})
    sazare::test::write_text(run / name, "mine");
  RunFolder(run, Begin::overwrite).clear();
  std::vector<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(run))
    if (entry.is_regular_file()) left.push_back(entry.path().filename().string());
  std::ranges::sort(left);
  EXPECT_EQ(left, (std::vector<std::string>{"elements.vtkhdf", "notes.txt", "particles_mine.vtkhdf"}));
  EXPECT_FALSE(fs::exists(run / "continuum"));
}

TEST(RunFolder, FilesOfTheUserWithTheNamesOfARunsAreKept) {
  for (const char* name : {"case.toml", "gauges.csv", "mesh.msh", "snapshots/elements_00000.vtkhdf"})
    for (const Begin begin : {Begin::fresh, Begin::overwrite, Begin::resume}) {
      const test::TemporaryFolder folder;
      sazare::test::write_text(folder / name, "mine");
      const std::string words = words_of_opening(folder.path(), begin);
      EXPECT_NE(words.find("is there already, and belongs to no run"), std::string::npos) << name << ": " << words;
      EXPECT_EQ(test::read_text(folder / name), "mine");
    }
}

TEST(RunFolder, LinksInItAreNotFollowed) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "elsewhere");
  for (const char* name : {"snapshots", "checkpoint", "bodies"}) {
    fs::create_directories(folder / name / "run");
    fs::create_directory_symlink(folder / "elsewhere", folder / name / "run" / name);
    const std::string words = words_of_opening(folder / name / "run", Begin::overwrite);
    EXPECT_NE(words.find("is a symbolic link"), std::string::npos) << name << ": " << words;
  }
}

TEST(RunFolder, WithAPipeInThePlaceOfAFileIsRefused) {
  const test::TemporaryFolder folder;
  for (const char* name : {"history.csv", "case.toml"}) {
    fs::create_directories(folder / name / "run");
    ASSERT_EQ(mkfifo((folder / name / "run" / name).c_str(), 0600), 0);
    for (const Begin begin : {Begin::overwrite, Begin::resume})
      EXPECT_NE(words_of_opening(folder / name / "run", begin).find(std::string(name) + ": is no file"), std::string::npos)
          << name;
  }
  ASSERT_EQ(mkfifo((folder / "manifest.json").c_str(), 0600), 0);
  EXPECT_EQ(run_status(folder / "."), "");
}

TEST(RunFolder, IsHeldByOneAtATime) {
  const test::TemporaryFolder folder;
  const RunFolder first(folder / "run", Begin::fresh);
  EXPECT_NE(words_of_opening(folder / "run", Begin::resume).find("another sazare process is using this folder"),
            std::string::npos);
}

TEST(RunFolder, ThatIsAFileIsRefused) {
  const test::TemporaryFolder folder;
  sazare::test::write_text(folder / "run", "a file");
  EXPECT_NE(words_of_opening(folder / "run", Begin::fresh).find("is a file"), std::string::npos);
}

}  // namespace
}  // namespace sazare::runs
