#include "tests/unit/runs/support.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <sstream>

#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/mesh_source.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::runs::test {

namespace fs = std::filesystem;

cases::CaseFile block_case(std::vector<std::string> settings) {
  std::vector<std::string> all = {"time.end=2e-4", "time.snapshot_interval=1e-4"};
  all.insert(all.end(), settings.begin(), settings.end());
  return registry::read_case("tests/regression/block/case.toml", all);
}

cases::CaseFile loose_case() {
  cases::CaseFile file = block_case();
  cases::Joint& joint = file.as<cases::BlocksCase>().joints.front();
  joint = {.name = joint.name, .between = joint.between, .surface = "", .bonded = false, .law_parameters = {}, .by_rate = {}};
  return file;
}

BlocksModel block_model(const cases::CaseFile& file) { return build_blocks(file.as<cases::BlocksCase>(), load_mesh(file, {}, true)); }

RunOutcome run_quietly(const cases::CaseFile& file, const fs::path& folder, Begin begin, const StopRequest& stop) {
  return registry::run_case(file, {folder, begin, true, stop});
}

std::int64_t run_whole(const cases::CaseFile& file, const fs::path& folder) {
  std::atomic<std::int64_t> asked = 0;
  EXPECT_FALSE(run_quietly(file, folder, Begin::fresh, StopRequest([&] { return ++asked < 0; })).stopped);
  return asked;
}

void run_in_parts(const cases::CaseFile& file, const fs::path& folder, std::int64_t asked_by_whole) {
  int resumed = 0;
  for (std::int64_t part = 1;; ++part) {
    std::atomic<std::int64_t> asked = 0;
    const StopRequest stop([&] { return ++asked > part * asked_by_whole / 5; });
    const RunOutcome outcome = run_quietly(file, folder, Begin::resume, stop);
    if (!outcome.stopped) break;
    EXPECT_EQ(read_manifest(folder)["status"], "stopped");
    if (outcome.begun) ++resumed;
  }
  EXPECT_GT(resumed, 0);
}

void expect_same_runs(const fs::path& one, const fs::path& other) {
  EXPECT_EQ(read_manifest(one)["state_hash"], read_manifest(other)["state_hash"]);
  EXPECT_EQ(without_last_column(read_text(one / "history.csv")), without_last_column(read_text(other / "history.csv")));
}

nlohmann::json read_manifest(const fs::path& folder) { return nlohmann::json::parse(read_text(folder / "manifest.json")); }

std::string without_last_column(const std::string& text) {
  std::istringstream stream(text);
  std::string kept;
  for (std::string line; std::getline(stream, line);) kept += line.substr(0, line.rfind(',')) + "\n";
  return kept;
}

}  // namespace sazare::runs::test
