#pragma once

/// What snapshots tell of natural joints.

#include <vector>

#include "sazare/methods/blocks/joints.hpp"

namespace sazare::runs {

/// By joint of the run, 0 of those that are not natural; all empty where none is.
struct NaturalJoints {
  std::vector<Real> path;           ///< of slip, the largest of the corners [m]
  std::vector<Real> mobilised_jrc;  ///< at that corner
  std::vector<Real> closure;        ///< of the joint without its springs, the largest of the corners [m]
  std::vector<Real> dilation;       ///< the largest of the corners [m]

  bool are_there() const { return !path.empty(); }
};

NaturalJoints natural_joints(const methods::blocks::Joints& joints);

}  // namespace sazare::runs
