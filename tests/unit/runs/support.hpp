#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/blocks_model.hpp"
#include "sazare/runs/run_blocks.hpp"

namespace sazare::runs::test {

/// A folder for one test, removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// The small block of tests/regression, to 2e-4 s, with overrides.
cases::CaseFile block_case(std::vector<std::string> settings = {});

/// The same, its faces never bonded.
cases::CaseFile loose_case();

/// The case and mesh of the small block, loaded and built.
BlocksModel block_model(const cases::CaseFile& file);

/// Carries out a case without a word.
RunOutcome run_quietly(const cases::CaseFile& file, const std::filesystem::path& folder, Begin begin = Begin::fresh,
                       const std::atomic<bool>* stop = nullptr);

std::string read_text(const std::filesystem::path& file);
nlohmann::json read_manifest(const std::filesystem::path& folder);

/// A table's text without its last column, the wall time.
std::string without_last_column(const std::string& text);

/// What an error says; empty when nothing was thrown.
template <class Error, class Action>
std::string words_of(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace sazare::runs::test
