#pragma once

#include "sazare/methods/mps/case/case.hpp"
#include "sazare/runs/run_identity.hpp"

namespace sazare::runs {

/// `filling` is a hash of where the particles stand.
RunIdentity identify(const cases::MpsCase& mps, const std::string& filling);

}  // namespace sazare::runs
