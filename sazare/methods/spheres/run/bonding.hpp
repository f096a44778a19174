#pragma once

/// Which spheres of a case are bonded, and their bonds.

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/spheres/bonds.hpp"
#include "sazare/methods/spheres/case/case.hpp"
#include "sazare/methods/spheres/run/placing/placement.hpp"

namespace sazare::runs {

/// The bonds of a case between spheres that have been placed. Throws UserError when an entry joins no spheres, or its fracture
/// energy is less than a bond holds when it begins to fail.
methods::spheres::Bonds bond_spheres(const cases::CaseFile& file, const Placement& placement);

}  // namespace sazare::runs
