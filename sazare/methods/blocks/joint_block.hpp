#pragma once

/// Bonded faces in blocks of `lane_count`, one per lane: what a kernel needs of them, column by column.

#include <array>

#include "sazare/core/lanes.hpp"
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

struct JointBlock {
  std::array<LaneVector, vertex_count> corner;  ///< a: vertex from the master's centre, in face axes [m]
  std::array<LaneVector, vertex_count> arm;     ///< b: vertex from the slave's centre, in its body frame [m]
  LaneMatrix frame;                             ///< Q: face axes (normal out of the master, two tangents) in its body frame
  std::array<std::array<Lanes, 2>, vertex_count> slip;  ///< u_0 [m]
  std::array<Lanes, vertex_count> peak;         ///< largest opening, at least the elastic one [m]
  std::array<Lanes, vertex_count> unloading;    ///< slope to the origin [Pa/m]
  Lanes vertex_area;                            ///< A: a third of the face [m2]
  Lanes slip_work;                              ///< energy that slip has taken [J]
  Lanes released;                               ///< elastic energy when the face came apart [J]
  std::array<Index, lane_count> master;
  std::array<Index, lane_count> slave;
  std::array<Index, lane_count> kind;
  std::array<JointState, lane_count> state;
};

/// Where a joint stands.
struct JointPlace {
  std::size_t block = 0;
  int lane = 0;
};

inline JointPlace place_of(Index joint) { return {static_cast<std::size_t>(joint / lane_count), joint % lane_count}; }

}  // namespace sazare::methods::blocks
