#pragma once

#include <memory>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/strength_reduction.hpp"

namespace sazare::runs {

/// Ground of particles with its strength divided by factors. Throws UserError where the case has no gravity or no strength, or
/// soil that degrades with strain, whose strength cannot be divided. The case must outlive it.
std::unique_ptr<StrengthReduction> reduce_strength_of_mps(const cases::CaseFile& file);

}  // namespace sazare::runs
