#pragma once

#include <memory>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/live_run.hpp"

namespace sazare::runs {

/// A case of method hybrid in its folder, ready to begin or to be resumed. The case must outlive the run. Throws UserError or
/// MachineError.
std::unique_ptr<LiveRun> open_hybrid(const cases::CaseFile& file, const RunOptions& options);

/// What a case will do, in words. Throws UserError with everything that is wrong.
std::string check_hybrid(const cases::CaseFile& file);

/// One side of a case; the other one is in another program.
std::unique_ptr<LiveRun> open_continuum(const cases::CaseFile& file, const RunOptions& options);
std::unique_ptr<LiveRun> open_bodies(const cases::CaseFile& file, const RunOptions& options);

}  // namespace sazare::runs
