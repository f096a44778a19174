#pragma once

/// The motion of all bodies of a run at one time, for readers outside: rows in the order in which the run writes its snapshots.

#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::runs {

struct MotionTable {
  std::vector<Vector3> position;  ///< of the centre [m]; in the plane z is 0
  std::vector<Vector3> velocity;  ///< [m/s]
  std::vector<Vector3> force;     ///< all of it, gravity too [N]; in the plane [N/m]

  /// The rows stay where they are in memory as long as their number stays.
  void resize(std::size_t bodies) {
    for (auto* rows : {&position, &velocity, &force}) rows->assign(bodies, Vector3::Zero());
  }
};

}  // namespace sazare::runs
