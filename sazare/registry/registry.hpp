#pragma once

/// Cases and runs of any method: whoever reads, checks or runs a case without knowing its method calls this.

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "sazare/runs/method.hpp"
#include "sazare/runs/studies/run_study.hpp"

namespace sazare::registry {

/// The table of all methods, in the order of the reference.
std::span<const runs::Method> methods();

/// The row of a method. Throws std::out_of_range where there is none of that name.
const runs::Method& method(std::string_view name);

/// Reads and checks a case of any method; see cases::read_case.
cases::CaseFile read_case(const std::filesystem::path& path, std::span<const std::string> overrides = {});

/// Reads and checks a case from a text; see cases::read_case_text.
cases::CaseFile read_case_text(const std::string& content, const std::filesystem::path& path,
                               std::span<const std::string> overrides = {});

/// The case as TOML with every key and default written out; files as full paths where `folder` is empty.
std::string write_resolved(const cases::CaseFile& file, const std::filesystem::path& folder = {});

/// A case in its folder, ready to begin or to be resumed. The case must outlive the run. Throws UserError or MachineError.
std::unique_ptr<runs::LiveRun> open_case(const cases::CaseFile& file, const runs::RunOptions& options);

/// Carries out a case in a folder: from the beginning or from its checkpoint, to the end or until it is asked to stop. Throws
/// UserError, PhysicsError or MachineError; what was written until then can be resumed from the last checkpoint.
runs::RunOutcome run_case(const cases::CaseFile& file, const runs::RunOptions& options);

/// What a case will do, in words. Throws UserError with everything that is wrong.
std::string check_case(const cases::CaseFile& file);

/// Seeks in every case of a study what it asks for; see runs::run_study.
runs::StudyOutcome run_study(const cases::Study& study, const runs::StudyOptions& options);

/// JSON schema and reference page of the case file, reference page of a run's folder.
std::string schema_json();
std::string schema_markdown();
std::string folder_markdown();

}  // namespace sazare::registry
