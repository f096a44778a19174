#pragma once

/// Equilibrium before time begins: dynamic relaxation with kinetic damping (Cundall). All elements stop whenever their kinetic
/// energy has passed a maximum, until no force is left that nothing balances. Meanwhile absorbing boundaries are fixed, and what
/// acts from a time on does not act.

#include <string>

#include "sazare/methods/blocks/run/model.hpp"
#include "sazare/runs/run_options.hpp"

namespace sazare::runs {

/// Instead of the start of a simulation of a case that settles. False when asked to stop before the equilibrium is there. Throws
/// a PhysicsError where there is none.
bool relax(const cases::BlocksCase& blocks, BlocksModel& model, const RunOptions& options);

/// What the equilibrium has cost, where the user may not expect it.
std::string warn_of_relaxation(const cases::CaseFile& file, const BlocksModel& model);

}  // namespace sazare::runs
