#pragma once

/// A case of any method: the one place that asks which.

#include <string>

#include "sazare/runs/run_blocks.hpp"

namespace sazare::runs {

/// Carries out a case in a folder. Throws like `run_blocks`.
RunOutcome run_case(const cases::CaseFile& file, const RunOptions& options);

/// What a case will do, in words. Throws UserError with everything that is wrong.
std::string check_case(const cases::CaseFile& file);

/// The same for method mps alone.
RunOutcome run_mps(const cases::CaseFile& file, const RunOptions& options);
std::string check_mps(const cases::CaseFile& file);

/// The same for method rectangles alone.
RunOutcome run_rectangles(const cases::CaseFile& file, const RunOptions& options);
std::string check_rectangles(const cases::CaseFile& file);

/// The same for method spheres alone.
RunOutcome run_spheres(const cases::CaseFile& file, const RunOptions& options);
std::string check_spheres(const cases::CaseFile& file);

/// The same for method fem alone.
RunOutcome run_fem(const cases::CaseFile& file, const RunOptions& options);
std::string check_fem(const cases::CaseFile& file);

}  // namespace sazare::runs
