#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
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
                       const StopRequest& stop = {});

/// Carries out a case without a word, and returns how often it asked whether it is to stop.
std::int64_t run_whole(const cases::CaseFile& file, const std::filesystem::path& folder);

/// Carries out a case without a word in parts: the first is stopped when it has asked a fifth of the times that the whole asks,
/// each part goes on from the checkpoint of the one before it, and is longer. At least one must be stopped after its beginning.
void run_in_parts(const cases::CaseFile& file, const std::filesystem::path& folder, std::int64_t asked_by_whole);

/// Expects the same state and the same history of two runs.
void expect_same_runs(const std::filesystem::path& one, const std::filesystem::path& other);

nlohmann::json read_manifest(const std::filesystem::path& folder);

/// A table's text without its last column, the wall-clock time.
std::string without_last_column(const std::string& text);

}  // namespace sazare::runs::test
