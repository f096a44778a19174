#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/blocks/run/model.hpp"
#include "sazare/registry/registry.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sazare::runs::test {

using sazare::test::read_text;
using sazare::test::TemporaryFolder;
using sazare::test::words_of;

/// The small block of tests/regression, to 2e-4 s, with overrides.
cases::CaseFile block_case(std::vector<std::string> settings = {});

/// The case of `block_case` whose faces are not bonded.
cases::CaseFile loose_case();

/// The case and mesh of the small block, loaded and built.
BlocksModel block_model(const cases::CaseFile& file);

/// Carries out a case without a word.
RunOutcome run_quietly(const cases::CaseFile& file, const std::filesystem::path& folder, Begin begin = Begin::fresh,
                       const std::atomic<bool>* stop = nullptr);

nlohmann::json read_manifest(const std::filesystem::path& folder);

/// A table's text without its last column, the wall-clock time.
std::string without_last_column(const std::string& text);

}  // namespace sazare::runs::test
