#pragma once

#include "sazare/methods/spheres/run/placing/placement.hpp"
#include "sazare/methods/spheres/water_forces.hpp"

namespace sazare::runs {

/// What the water of a case does to its spheres; nothing where there is none. A body is met by the water as a sphere of its volume
/// is, whose area its spheres share out by volume. `step` is the longest one [s]. Throws UserError where drag is too stiff for it.
methods::spheres::WaterForces water_around(const cases::CaseFile& file, const Placement& placement, Real step);

}  // namespace sazare::runs
