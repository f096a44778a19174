#pragma once

#include <memory>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/live_run.hpp"

namespace sazare::runs {

/// A case of method blocks in its folder, ready to begin or to be resumed. The case must outlive the run. Throws UserError or
/// MachineError.
std::unique_ptr<LiveRun> open_blocks(const cases::CaseFile& file, const RunOptions& options);

/// What a case will do, in words. Throws UserError with everything that is wrong.
std::string check_blocks(const cases::CaseFile& file);

/// How so many processes would share the case: what each policy makes of the levels at the beginning.
std::string explain_ranks_of_blocks(const cases::CaseFile& file, int ranks);

}  // namespace sazare::runs
