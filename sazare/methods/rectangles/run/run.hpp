#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/live_run.hpp"

namespace sazare::runs {

/// A case of method rectangles in its folder, ready to begin or to be resumed. The case must outlive the run. Throws UserError or
/// MachineError.
std::unique_ptr<LiveRun> open_rectangles(const cases::CaseFile& file, const RunOptions& options);

/// What a case will do, in words; `window`: of a coupling, in whose windows it is run [s]. Throws UserError with everything
/// that is wrong.
std::string check_rectangles(const cases::CaseFile& file, std::optional<Real> window = std::nullopt);

}  // namespace sazare::runs
