#pragma once

#include "sazare/methods/fem/case/case.hpp"
#include "sazare/runs/run_identity.hpp"

namespace sazare::runs {

/// `mesh` is a hash of nodes, elements and groups.
RunIdentity identify(const cases::FemCase& fem, const std::string& mesh);

}  // namespace sazare::runs
