#pragma once

/// A case of any method: the one place that asks which.

#include <memory>
#include <optional>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/live_run.hpp"

namespace sazare::runs {

/// A case in its folder, ready to begin or to be resumed. The case must outlive the run. Throws UserError or MachineError.
std::unique_ptr<LiveRun> open_case(const cases::CaseFile& file, const RunOptions& options);

/// Carries out a case in a folder: from the beginning or from its checkpoint, to the end or until it is asked to stop. Throws
/// UserError, PhysicsError or MachineError; what was written until then can be resumed from the last checkpoint.
RunOutcome run_case(const cases::CaseFile& file, const RunOptions& options);

/// What a case will do, in words. Throws UserError with everything that is wrong.
std::string check_case(const cases::CaseFile& file);

/// The same for method blocks alone; its check is in check_blocks.hpp.
std::unique_ptr<LiveRun> open_blocks(const cases::CaseFile& file, const RunOptions& options);

/// The same for method mps alone.
std::unique_ptr<LiveRun> open_mps(const cases::CaseFile& file, const RunOptions& options);
std::string check_mps(const cases::CaseFile& file);

/// The same for method rectangles alone.
std::unique_ptr<LiveRun> open_rectangles(const cases::CaseFile& file, const RunOptions& options);
/// `window`: of a coupling, in whose windows it is run [s].
std::string check_rectangles(const cases::CaseFile& file, std::optional<Real> window = std::nullopt);

/// The same for method spheres alone.
std::unique_ptr<LiveRun> open_spheres(const cases::CaseFile& file, const RunOptions& options);
std::string check_spheres(const cases::CaseFile& file);

/// The same for method fem alone.
std::unique_ptr<LiveRun> open_fem(const cases::CaseFile& file, const RunOptions& options);
std::string check_fem(const cases::CaseFile& file);

/// The same for method hybrid alone.
std::unique_ptr<LiveRun> open_hybrid(const cases::CaseFile& file, const RunOptions& options);
std::string check_hybrid(const cases::CaseFile& file);

/// One side of a hybrid case; the other one is in another program.
std::unique_ptr<LiveRun> open_continuum(const cases::CaseFile& file, const RunOptions& options);
std::unique_ptr<LiveRun> open_bodies(const cases::CaseFile& file, const RunOptions& options);

}  // namespace sazare::runs
