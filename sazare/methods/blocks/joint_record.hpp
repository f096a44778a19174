#pragma once

/// Bonded faces as records in memory, and several of them as lanes.

#include <array>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/rotation.hpp"
#include "sazare/core/time.hpp"
#include "sazare/laws/joint_shear.hpp"
#include "sazare/laws/joint_tension.hpp"

namespace sazare::methods::blocks {

enum class JointState : std::int16_t { intact, softening, broken };

/// Strength and stiffness of a kind of joint; `P` as in the laws.
template <class P>
struct JointParameters {
  laws::TensionParameters<P> tension;
  laws::ShearParameters<P> shear;
  P normal_damping{};  ///< c_n [Pa s/m]
  P shear_damping{};   ///< c_s [Pa s/m]
};

using JointKind = JointParameters<Real>;

inline constexpr int vertex_count = 3;

/// One joint in memory, as small as it goes: a run waits for these records more than for anything. What it remembers comes first
/// and is written back after an evaluation where it has changed. Places on the slave, the face's axes and slips are rounded to
/// single precision, and everything else follows what they have been rounded to: a joint is at rest, to round-off, as it was
/// given.
struct alignas(64) JointRecord {
  std::array<std::array<float, 2>, vertex_count> slip{};  ///< u_0, by vertex [m]
  std::array<Real, vertex_count> peak{};                  ///< by vertex: largest opening, at least the elastic one [m]
  std::array<Vector3, vertex_count> corner;               ///< a: vertex from the master's centre, in face axes [m]
  std::array<std::array<float, 3>, vertex_count> arm{};   ///< b: vertex from the slave's centre, in its body frame [m]
  std::int16_t kind = 0;
  JointState state = JointState::intact;
  std::array<float, 4> axes{};  ///< quaternion x, y, z, w, its length any: Q in the master's body frame
  Real vertex_area = 0;         ///< A: a third of the face [m2]
  Index master = 0;
  Index slave = 0;

  /// Q: face axes (normal out of the master, two tangents) in its body frame, columns.
  Matrix3 frame() const { return Quaternion(axes[3], axes[0], axes[1], axes[2]).normalized().toRotationMatrix(); }
  Vector3 arm_of(std::size_t vertex) const { return {arm[vertex][0], arm[vertex][1], arm[vertex][2]}; }
};
inline constexpr int joint_numbers = 24;  ///< doubles, or pairs of what is shorter
static_assert(sizeof(JointRecord) == joint_numbers * sizeof(Real));

/// What a joint has taken for good.
struct JointLosses {
  Real slip_work = 0;  ///< [J]
  Real released = 0;   ///< elastic energy when the face came apart [J]
};

/// Joints in lanes.
struct LaneJoints {
  std::array<std::array<Lanes, 2>, vertex_count> slip;
  LaneVector peak;
  LaneMatrix frame;
  std::array<LaneVector, vertex_count> corner, arm;
  Lanes vertex_area{};
};

template <class Record>  // JointRecord, const or not
LaneJoints load_joints(const LanePointers<Record>& records) {
  const auto f = load_records<joint_numbers>(records);
  LaneJoints joints;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    joints.slip[v] = unpack(f[v]);
    joints.corner[v] = {{f[6 + 3 * v], f[7 + 3 * v], f[8 + 3 * v]}};
  }
  joints.peak = {{f[3], f[4], f[5]}};
  std::array<Lanes, 10> arm;
  for (std::size_t pair = 0; pair < 5; ++pair) {
    const auto both = unpack(f[15 + pair]);
    arm[2 * pair] = both[0], arm[2 * pair + 1] = both[1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) joints.arm[v] = {{arm[3 * v], arm[3 * v + 1], arm[3 * v + 2]}};
  const auto [x, y] = unpack(f[20]);
  const auto [z, w] = unpack(f[21]);
  joints.frame = rotation_of(2.0 / (x * x + y * y + z * z + w * w), x, y, z, w);
  joints.vertex_area = f[22];
  return joints;
}

/// Writes what the first `count` lanes remember back, with the part of a corner that fills the row.
inline void store_memory(const LaneJoints& joints, const LanePointers<JointRecord>& records, int count) {
  std::array<Lanes, 8> row;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    row[v] = pack(joints.slip[v][0], joints.slip[v][1]);
    row[3 + v] = joints.peak[static_cast<int>(v)];
  }
  row[6] = joints.corner[0][0], row[7] = joints.corner[0][1];
  store_records<8>(row, records, count);
}

}  // namespace sazare::methods::blocks
