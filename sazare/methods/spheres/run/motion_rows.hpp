#pragma once

#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/runs/motion_table.hpp"

namespace sazare::runs {

/// By number of the sphere, whatever their order in memory. Evaluates the forces, which the next step takes over.
void read_spheres(methods::spheres::SphereStepper& stepper, MotionTable& table);


}  // namespace sazare::runs
