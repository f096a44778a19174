#pragma once

#include "sazare/methods/hybrid/case/case.hpp"
#include "sazare/runs/run_identity.hpp"

namespace sazare::runs {

/// Identity of a hybrid run, from those of its two sides.
RunIdentity identify(const cases::HybridCase& hybrid, const RunIdentity& continuum, const RunIdentity& bodies);

}  // namespace sazare::runs
