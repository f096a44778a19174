#pragma once

#include <memory>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/live_run.hpp"

namespace sazare::runs {

/// With fewer a second thread takes more time than it saves.
inline constexpr int fem_elements_per_thread = 500;

/// A case of method fem in its folder, ready to begin or to be resumed. The case must outlive the run. Throws UserError or
/// MachineError.
std::unique_ptr<LiveRun> open_fem(const cases::CaseFile& file, const RunOptions& options);

/// What a case will do, in words. Throws UserError with everything that is wrong.
std::string check_fem(const cases::CaseFile& file);

}  // namespace sazare::runs
