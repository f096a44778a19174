#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/mps/run/model.hpp"
#include "sazare/runs/live_run.hpp"

namespace sazare::runs {

/// A case of method mps in its folder, ready to begin or to be resumed. The case must outlive the run. Throws UserError or
/// MachineError.
std::unique_ptr<LiveRun> open_mps(const cases::CaseFile& file, const RunOptions& options);

/// What a case will do, alone or in a coupling, in words. Throws UserError with everything that is wrong.
std::string check_mps(const cases::CaseFile& file, const std::optional<MpsCoupling>& coupling = std::nullopt);

}  // namespace sazare::runs
