#pragma once

/// Bonded faces as records in memory, and several of them as lanes.

#include <array>

#include "sazare/core/lane_records.hpp"
#include "sazare/core/time.hpp"
#include "sazare/laws/joint_shear.hpp"
#include "sazare/laws/joint_tension.hpp"

namespace sazare::methods::blocks {

enum class JointState : std::int32_t { intact, softening, broken };

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

/// What a joint remembers. Written back after an evaluation only where it has changed.
template <class T, class V>
struct JointMemory {
  std::array<std::array<T, 2>, vertex_count> slip{};  ///< u_0 [m]
  T slip_work{};                                      ///< energy that slip has taken [J]
  T released{};                                       ///< elastic energy when the face came apart [J]
  V peak{};                                           ///< by vertex: largest opening, at least the elastic one [m]
  V unloading{};                                      ///< by vertex: slope to the origin [Pa/m]
};

/// Where the vertices are.
template <class T, class V>
struct JointShape {
  std::array<V, 3> frame;              ///< Q: face axes (normal out of the master, two tangents) in its body frame, columns
  std::array<V, vertex_count> corner;  ///< a: vertex from the master's centre, in face axes [m]
  std::array<V, vertex_count> arm;     ///< b: vertex from the slave's centre, in its body frame [m]
  T vertex_area{};                     ///< A: a third of the face [m2]
};

/// One joint in memory. Its doubles are read by number (see `load_joints`).
struct alignas(64) JointRecord {
  JointMemory<Real, Vector3> memory;  // 14 doubles
  std::array<Real, 2> unused{};       // the shape begins on a cache line
  JointShape<Real, Vector3> shape;    // 28 doubles
  Index master = 0;
  Index slave = 0;
  Index kind = 0;
  JointState state = JointState::intact;
};
static_assert(sizeof(JointRecord) == 48 * sizeof(Real));

/// Joints in lanes.
struct LaneJoints {
  JointMemory<Lanes, LaneVector> memory;
  JointShape<Lanes, LaneVector> shape;
};

template <class Record>  // of a JointRecord, const or not
LaneJoints load_joints(const LanePointers<Record>& records) {
  const auto f = load_records<48>(records);
  const auto vector = [&](std::size_t first) { return LaneVector{{f[first], f[first + 1], f[first + 2]}}; };
  return {
      {{{{f[0], f[1]}, {f[2], f[3]}, {f[4], f[5]}}}, f[6], f[7], vector(8), vector(11)},
      {{vector(16), vector(19), vector(22)}, {vector(25), vector(28), vector(31)}, {vector(34), vector(37), vector(40)}, f[43]}};
}

/// Writes the memory of the first `count` lanes back.
inline void store_memory(const JointMemory<Lanes, LaneVector>& m, const LanePointers<JointRecord>& records, int count) {
  store_records<16>({m.slip[0][0], m.slip[0][1], m.slip[1][0], m.slip[1][1], m.slip[2][0], m.slip[2][1], m.slip_work, m.released,
                     m.peak[0], m.peak[1], m.peak[2], m.unloading[0], m.unloading[1], m.unloading[2], Lanes{}, Lanes{}},
                    records, count);
}

}  // namespace sazare::methods::blocks
