#pragma once

/// What falls before a run begins.

#include "sazare/methods/spheres/run/model.hpp"
#include "sazare/runs/run_options.hpp"

namespace sazare::runs {

/// Lets those groups of a case that rain fall until they rest, with progress on the terminal; nothing where none does. False when
/// asked to stop before. Throws PhysicsError where they do not come to rest.
bool let_rain(const cases::SpheresCase& spheres, SpheresModel& model, const RunOptions& options);

}  // namespace sazare::runs
