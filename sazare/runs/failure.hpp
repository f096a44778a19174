#pragma once

#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/runs/blocks_model.hpp"

namespace sazare::runs {

/// Says which element's motion is no number any more, where it was, when, and what probably drove it there.
std::string describe_failure(const BlocksModel& model, const cases::CaseFile& file, Real time);

}  // namespace sazare::runs
