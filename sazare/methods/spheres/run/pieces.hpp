#pragma once

/// What has become of the bonded bodies of a run of method spheres.

#include "sazare/methods/spheres/run/model.hpp"
#include "sazare/runs/fragments.hpp"

namespace sazare::runs {

/// How many bodies are in more than one piece.
std::int64_t broken_bodies(const methods::spheres::BondedBodies& bodies);

/// Pieces of all bodies together.
std::int64_t count_pieces(const methods::spheres::BondedBodies& bodies);

/// By number of the sphere: its clump, or behind all clumps its bonded body; below 0 where it stands alone.
std::vector<std::int32_t> body_numbers(const SpheresModel& model);

/// The pieces of all bonded bodies, the largest first; volumes are shares of the bodies' volumes, ways begin where the bodies
/// were placed. `evaluate_now` has been called.
std::vector<Fragment> measure_pieces(const SpheresModel& model);

}  // namespace sazare::runs
