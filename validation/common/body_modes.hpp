#pragma once

/// Standing waves of bodies of blocks, read from their motion.

#include <functional>
#include <utility>

#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::validation {

/// Velocity and spin of a block in a mode of the body, by its centre at the beginning.
using Mode = std::function<std::pair<Vector3, Vector3>(const Vector3& centre)>;

/// Gives all blocks the motion of a mode, times 1e-3.
void set_motion(levels::Simulation<3>& simulation, const Mode& mode);

/// Lets a body swing in a mode for two periods. Half its period [s] is read from the times at which the motion has no component
/// left in the mode; `look` sees the body after every base step.
Real half_period(
    levels::Simulation<3>& simulation, const Mode& mode,
    const std::function<void(const levels::Snapshot<3>&)>& look = [](const auto&) {});

}  // namespace sazare::validation
