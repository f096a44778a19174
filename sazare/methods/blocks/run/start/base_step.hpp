#pragma once

#include <span>
#include <vector>

#include "sazare/methods/blocks/rates/joint_rates.hpp"

namespace sazare::runs {

/// The base step [s] for which the joints need the fewest evaluations, each body stepping at the coarsest level
/// under its `steps` [s]. It divides the history interval a whole number of times.
Real choose_base_step(std::span<const Real> steps, std::span<const methods::blocks::JointFace> faces, Real history_interval);

/// Sorts faces by the level of their joints, otherwise as they stood: what is due together then stands together.
void sort_by_level(std::vector<methods::blocks::JointFace>& faces, std::span<const Real> steps, Real base_step);

}  // namespace sazare::runs
