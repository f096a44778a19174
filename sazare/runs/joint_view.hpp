#pragma once

/// What results need of a joint: the one place that knows how joints keep their memory.

#include <array>

#include "sazare/methods/blocks/joints.hpp"

namespace sazare::runs {

/// Size of the records that a checkpoint holds [bytes].
inline constexpr std::size_t joint_record_size = sizeof(methods::blocks::Joint);

inline Index joint_count(const methods::blocks::Joints& joints) {
  return static_cast<Index>(joints.joints().size());
}

inline methods::blocks::JointState joint_state(const methods::blocks::Joints& joints, Index joint) {
  return joints.joints()[static_cast<std::size_t>(joint)].state;
}

inline bool joint_holds(const methods::blocks::Joints& joints, Index joint) {
  return joint_state(joints, joint) != methods::blocks::JointState::broken;
}

/// Place of a joint's entry in the case's [[joints]].
inline Index joint_kind(const methods::blocks::Joints& joints, Index joint) {
  return joints.joints()[static_cast<std::size_t>(joint)].kind;
}

/// Slip in two directions and largest opening of the three vertices [m].
inline std::array<Real, 9> joint_memory(const methods::blocks::Joints& joints, Index joint) {
  const methods::blocks::Joint& at = joints.joints()[static_cast<std::size_t>(joint)];
  return {at.slip[0][0], at.slip[0][1], at.slip[0][2], at.slip[1][0], at.slip[1][1],
          at.slip[1][2], at.peak[0],    at.peak[1],    at.peak[2]};
}

}  // namespace sazare::runs
