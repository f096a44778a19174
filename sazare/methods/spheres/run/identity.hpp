#pragma once

#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/runs/run_identity.hpp"

namespace sazare::runs {

/// `start` is a hash of where spheres and walls stand at the start.
RunIdentity identify(const cases::SpheresCase& spheres, const std::string& start);

}  // namespace sazare::runs
