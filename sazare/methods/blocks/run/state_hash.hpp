#pragma once

#include <cstdint>

#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::runs {

/// Hash of the state at a base step: places, velocities and angular momenta of all elements, then every joint's state and
/// memory. Equal for equal runs, whatever the number of threads and however often they were interrupted.
std::uint64_t state_hash(const BlocksModel& model);

}  // namespace sazare::runs
