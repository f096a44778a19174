#include "tests/unit/runs/support.hpp"

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

RunOutcome run_quietly(const cases::CaseFile& file, const fs::path& folder, Begin begin, const std::atomic<bool>* stop) {
  return registry::run_case(file, {folder, begin, true, stop});
}

nlohmann::json read_manifest(const fs::path& folder) { return nlohmann::json::parse(read_text(folder / "manifest.json")); }

std::string without_last_column(const std::string& text) {
  std::istringstream stream(text);
  std::string kept;
  for (std::string line; std::getline(stream, line);) kept += line.substr(0, line.rfind(',')) + "\n";
  return kept;
}

}  // namespace sazare::runs::test
