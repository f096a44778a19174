#pragma once

#include <string>

#include "sazare/cases/case_file.hpp"

namespace sazare::runs {

/// What a case will do, in words, without running it: the case with all its defaults, the mesh, the steps and who limits
/// them. Throws UserError with everything that is wrong.
std::string check_blocks(const cases::CaseFile& file);

}  // namespace sazare::runs
