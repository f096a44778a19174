#pragma once

#include "sazare/methods/rectangles/case/case.hpp"
#include "sazare/runs/run_identity.hpp"

namespace sazare::runs {

/// `assembly` is a hash of where the elements stand.
RunIdentity identify(const cases::RectanglesCase& rectangles, const std::string& assembly);

}  // namespace sazare::runs
