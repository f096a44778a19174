#pragma once

/// Carries out a case of method blocks in a folder: from the beginning or from its checkpoint, to the end or until it is asked
/// to stop.

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/run_options.hpp"

namespace sazare::runs {

/// Throws UserError, PhysicsError or MachineError; what was written until then can be resumed from the last checkpoint.
RunOutcome run_blocks(const cases::CaseFile& file, const RunOptions& options);

}  // namespace sazare::runs
