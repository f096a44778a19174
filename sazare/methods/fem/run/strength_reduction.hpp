#pragma once

#include <memory>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/strength_reduction.hpp"

namespace sazare::runs {

/// Finite elements and joints with their strength divided by factors. Throws UserError where the case has no gravity or no
/// strength, or soil that degrades with strain, whose strength cannot be divided. The case must outlive it.
std::unique_ptr<StrengthReduction> reduce_strength_of_fem(const cases::CaseFile& file);

}  // namespace sazare::runs
