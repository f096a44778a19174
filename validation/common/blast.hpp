#pragma once

/// The blast of cases/free-face-blast with some keys set otherwise. Programs run in the repository's root.

#include <string>
#include <utility>
#include <vector>

#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::validation {

/// `overrides` as for `sazare run --set`. The simulation is started.
runs::BlocksModel started_blast(const std::vector<std::string>& overrides);

/// Advances to a time [s].
void advance_to(runs::BlocksModel& model, Real seconds);

/// Displacement of every element [m].
std::vector<Vector3> displacements(const runs::BlocksModel& model);

/// Root mean square of the difference of two displacements over that of the second.
Real relative_difference(const std::vector<Vector3>& one, const std::vector<Vector3>& other);

/// Distance of an element's centre from the axis of the blast hole at the beginning [m].
Real distance_from_hole(const runs::BlocksModel& model, std::size_t element);

/// Lowest and highest level in use.
std::pair<int, int> level_range(const levels::Simulation<3>& simulation);

/// Linear and angular momentum about the origin of all impulses given until a base step.
struct Momentum {
  Vector3 linear = Vector3::Zero();
  Vector3 angular = Vector3::Zero();
};
Momentum momentum(const levels::Simulation<3>& simulation);

}  // namespace sazare::validation
