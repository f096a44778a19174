#include "tests/unit/runs/support.hpp"

#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "sazare/runs/mesh_source.hpp"

namespace sazare::runs::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "sazare-runs-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

cases::CaseFile block_case(std::vector<std::string> settings) {
  std::vector<std::string> all = {"time.end=2e-4", "time.snapshot_interval=1e-4"};
  all.insert(all.end(), settings.begin(), settings.end());
  return cases::read_case("tests/regression/block/case.toml", all);
}

cases::CaseFile loose_case() {
  cases::CaseFile file = block_case();
  cases::Joint& joint = std::get<cases::BlocksCase>(file.content).joints.front();
  joint = {joint.name, joint.between, "", false};
  return file;
}

BlocksModel block_model(const cases::CaseFile& file) { return build_blocks(file.blocks(), load_mesh(file, {}, true)); }

RunOutcome run_quietly(const cases::CaseFile& file, const fs::path& folder, Begin begin, const std::atomic<bool>* stop) {
  return run_blocks(file, {folder, begin, true, stop});
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

nlohmann::json read_manifest(const fs::path& folder) { return nlohmann::json::parse(read_text(folder / "manifest.json")); }

std::string without_last_column(const std::string& text) {
  std::istringstream stream(text);
  std::string kept;
  for (std::string line; std::getline(stream, line);) kept += line.substr(0, line.rfind(',')) + "\n";
  return kept;
}

}  // namespace sazare::runs::test
