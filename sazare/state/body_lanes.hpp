#pragma once

/// Bodies, one in each lane.

#include "sazare/core/lane_records.hpp"
#include "sazare/state/bodies.hpp"

namespace sazare::state {

/// Places of bodies, one in each lane: of motions or of poses, which both begin with them.
struct LanePlaces {
  LaneVector position;
  LaneMatrix rotation;
};

template <class Body>
LanePlaces load_places(const LanePointers<Body>& bodies) {
  const auto n = load_records<12>(bodies);
  return {{{n[0], n[1], n[2]}},
          {{LaneVector{{n[3], n[4], n[5]}}, LaneVector{{n[6], n[7], n[8]}}, LaneVector{{n[9], n[10], n[11]}}}}};
}

/// Zero along axes that are locked, one in a bit.
inline LaneVector without(const LongLanes& locked, const LaneVector& v) {
  LaneVector left;
  for (int axis = 0; axis < 3; ++axis) left[axis] = select((locked >> axis & 1) == 0, v[axis], Lanes{});
  return left;
}

/// Predicted velocities of bodies that stand at their own time.
struct LaneVelocities {
  LaneVector velocity, spin;
};

inline LaneVelocities load_velocities(const LanePointers<const Motion<3>>& bodies) {
  const auto first = load_quad(bodies, 12), last = load_quad(bodies, 16);
  return {{{first[0], first[1], first[2]}}, {{first[3], last[0], last[1]}}};
}

}  // namespace sazare::state
