#pragma once

#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::runs {

/// An element whose motion has diverged: it is not a number, or goes farther in a step than the element is large.
/// -1 when there is none.
Index find_failed_element(BlocksModel& model);

/// Says which element has failed in this sense, where it was, when, and what probably drove it there.
std::string describe_failure(const BlocksModel& model, const cases::CaseFile& file, Real time);

}  // namespace sazare::runs
