#pragma once

/// Where points of elements are, and how fast they move.

#include "sazare/engine/simulation.hpp"

namespace sazare::runs {

/// Where a point that was at `start` is now, as a point of this element [m].
Vector3 moved_point(const state::Bodies<3>& bodies, const engine::Snapshot<3>& now, Index element, const Vector3& start);

/// Velocity of the same point [m/s].
Vector3 point_velocity(const state::Bodies<3>& bodies, const engine::Snapshot<3>& now, Index element, const Vector3& start);

}  // namespace sazare::runs
