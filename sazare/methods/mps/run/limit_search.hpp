#pragma once

/// The limit step of a case by trial: runs with different steps, until a step that holds and one that does not are close.

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/stability_limit.hpp"

namespace sazare::runs {

/// Bisection on the geometric mean, from the time that a P wave takes over a spacing on: the prediction is put beside the result
/// and takes no part in it. Throws UserError when no step holds.
FoundLimit find_limit(const cases::CaseFile& file, const LimitRules& rules);

}  // namespace sazare::runs
