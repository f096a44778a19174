#pragma once

/// What falls before a run begins.

#include "sazare/runs/run_options.hpp"
#include "sazare/runs/spheres_model.hpp"

namespace sazare::runs {

/// Lets those groups of a case that rain fall until they rest, with progress on the terminal; nothing where none does. False when
/// asked to stop before. Throws PhysicsError where they do not come to rest.
bool let_rain(const cases::SpheresCase& spheres, SpheresModel& model, const RunOptions& options);

}  // namespace sazare::runs
