#pragma once

#include <span>

#include "sazare/methods/blocks/joints.hpp"

namespace sazare::runs {

/// The base step [s] for which the joints need the fewest evaluations, each body stepping at the coarsest level
/// under its own stable step. It divides the history interval a whole number of times.
Real choose_base_step(std::span<const Real> stable_steps, const methods::blocks::Joints& joints, Real fraction,
                      Real history_interval);

}  // namespace sazare::runs
