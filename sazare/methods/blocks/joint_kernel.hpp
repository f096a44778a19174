#pragma once

/// The force of a bonded face, in every lane of a block.
///
///     d = E^T (x_j + R_j b - x_i) - a       relative displacement of the slave's vertex in face axes
///     E = R_i Q                             face axes: normal out of the master, two tangents
///     f = -A (s(d_n) + c_n v_n) n - A (k_s d_t + c_s v_t)
///
/// x, R place and rotation of master i and slave j; a, b the vertex in face axes of the master and in the slave's body
/// frame; A a third of the face [m2]. The force acts at the one point x_j + R_j b on both bodies, so it derives from a
/// potential and conserves linear and angular momentum exactly. Everything is worked out in face axes and turned to
/// world axes once. [Konno2018], 2.1, figs. 1 and 2.

#include "sazare/core/lane_records.hpp"
#include "sazare/methods/blocks/joint_block.hpp"
#include "sazare/state/bodies.hpp"

namespace sazare::methods::blocks {

/// Bodies, one in each lane, at one moment.
struct LaneBodies {
  LaneVector position, velocity, spin;
  LaneMatrix rotation;
};

/// Loads bodies and drifts those back that have their next time later than now: x + v t, and R + [w t] R + [w t]^2 R / 2.
inline LaneBodies load_bodies(const LanePointers<const state::Motion<3>>& bodies, const Moment& now) {
  const auto f = load_records<24>(bodies);
  LaneBodies at{{{f[0], f[1], f[2]}}, {{f[3], f[4], f[5]}}, {{f[17], f[18], f[19]}},
                {{LaneVector{{f[8], f[9], f[10]}}, LaneVector{{f[11], f[12], f[13]}}, LaneVector{{f[14], f[15], f[16]}}}}};
  const LongLanes late = now.tick - reinterpret_cast<LongLanes>(f[7]);
  if (!any(late != 0)) return at;
  const Lanes seconds = __builtin_convertvector(late, Lanes) * now.tick_seconds;
  at.position = at.position + seconds * at.velocity;
  const LaneVector angle = seconds * at.spin;
  for (int axis = 0; axis < 3; ++axis) {
    const LaneVector turned = cross(angle, at.rotation[axis]);
    at.rotation[axis] = at.rotation[axis] + turned + broadcast(0.5) * cross(angle, turned);
  }
  return at;
}

/// Vertices in face axes.
struct FaceGeometry {
  LaneMatrix axes;    ///< E
  LaneVector apart;   ///< x_j - x_i in face axes [m]
  std::array<LaneVector, vertex_count> point;         ///< from the master's centre [m]
  std::array<LaneVector, vertex_count> displacement;  ///< d [m]
};

inline FaceGeometry face_geometry(const JointBlock& block, const LaneBodies& master, const LaneBodies& slave) {
  FaceGeometry at;
  at.axes = master.rotation * block.frame;
  at.apart = transposed(at.axes, slave.position - master.position);
  LaneMatrix slave_axes;  // slave's body frame to face axes
  for (int i = 0; i < 3; ++i) slave_axes[i] = transposed(at.axes, slave.rotation[i]);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    at.point[v] = slave_axes * block.arm[v] + at.apart;
    at.displacement[v] = at.point[v] - block.corner[v];
  }
  return at;
}

/// Impulses that a face gives to both its bodies, about their centres, in world axes.
struct FaceImpulse {
  LaneVector linear, angular;                  ///< on the body, all of it
  LaneVector dashpot_linear, dashpot_angular;  ///< part of it
};
struct JointImpulses {
  FaceImpulse master, slave;
};

/// Recoverable energy [J].
inline Lanes elastic_energy(const JointBlock& block, const JointParameters<Lanes>& kind, const FaceGeometry& at) {
  Lanes energy{};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const LaneVector& d = at.displacement[v];
    const Lanes x = d[1] - block.slip[v][0], y = d[2] - block.slip[v][1];
    energy += laws::tension_energy(kind.tension, d[0], block.unloading[v]) + 0.5 * kind.shear.stiffness * (x * x + y * y);
  }
  return energy * block.vertex_area;
}

/// Raises the memory of the `due` joints to the present opening. Says which have failed at a vertex: their whole face
/// comes apart, and what was stored in it is lost.
inline LaneMask soften(JointBlock& block, const JointParameters<Lanes>& kind, const FaceGeometry& at, LaneMask due) {
  LaneMask failed{};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const LaneMask opens = due & (at.displacement[v][0] > block.peak[v]);
    const Lanes peak = select(opens, at.displacement[v][0], block.peak[v]);
    block.peak[v] = peak;
    block.unloading[v] = select(opens, laws::unloading_stiffness(kind.tension, peak), block.unloading[v]);
    failed |= due & (peak >= kind.tension.failure_opening);
    for (int lane = 0; lane < lane_count; ++lane)
      if (opens[lane] != 0) block.state[static_cast<std::size_t>(lane)] = JointState::softening;
  }
  if (any(failed)) {
    block.released = select(failed, elastic_energy(block, kind, at), block.released);
    for (int lane = 0; lane < lane_count; ++lane)
      if (failed[lane] != 0) block.state[static_cast<std::size_t>(lane)] = JointState::broken;
  }
  return failed;
}

/// Evaluates the `due` joints of a block over the time each acts. Returns those that have failed: they give nothing.
inline LaneMask evaluate(JointBlock& block, const JointParameters<Lanes>& kind, const LaneBodies& master,
                         const LaneBodies& slave, LaneMask due, Lanes acting, JointImpulses& given) {
  const FaceGeometry at = face_geometry(block, master, slave);
  LaneMask opening{}, failed{};
  for (std::size_t v = 0; v < vertex_count; ++v) opening |= at.displacement[v][0] > block.peak[v];
  if (any(due & opening)) failed = soften(block, kind, at, due);

  const LaneVector slave_spin = transposed(at.axes, slave.spin);
  const LaneVector spin = slave_spin - transposed(at.axes, master.spin);
  const LaneVector velocity = transposed(at.axes, slave.velocity - master.velocity) - cross(slave_spin, at.apart);
  const Lanes area = -block.vertex_area * acting;
  LaneVector spring_sum, dashpot_sum, spring_moment, dashpot_moment;  // about the master, in face axes
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const LaneVector& d = at.displacement[v];
    const Lanes stress = laws::tension_stress(kind.tension, d[0], block.unloading[v]);
    laws::Slip<Lanes> shear{{d[1] - block.slip[v][0], d[2] - block.slip[v][1]}, {block.slip[v][0], block.slip[v][1]}, {}};
    const Lanes strength = laws::shear_strength(kind.shear, stress);
    if (any(due & laws::slips(kind.shear, shear, strength))) {
      laws::slip_back(kind.shear, shear, strength);
      const LaneMask holds = due & ~failed;
      for (std::size_t axis = 0; axis < 2; ++axis)
        block.slip[v][axis] = select(holds, shear.memory[axis], block.slip[v][axis]);
      block.slip_work += select(holds, block.vertex_area * shear.dissipation, Lanes{});
    }
    const LaneVector speed = velocity + cross(spin, at.point[v]);
    const LaneVector spring{{area * stress, area * (kind.shear.stiffness * shear.elastic[0]),
                             area * (kind.shear.stiffness * shear.elastic[1])}};
    const LaneVector dashpot{{area * (kind.normal_damping * speed[0]), area * (kind.shear_damping * speed[1]),
                              area * (kind.shear_damping * speed[2])}};
    spring_sum = spring_sum + spring;
    dashpot_sum = dashpot_sum + dashpot;
    spring_moment = spring_moment + cross(at.point[v], spring);
    dashpot_moment = dashpot_moment + cross(at.point[v], dashpot);
  }
  const LaneVector sum = spring_sum + dashpot_sum, moment = spring_moment + dashpot_moment;
  const LaneVector zero;
  given.slave = {at.axes * sum, at.axes * (moment - cross(at.apart, sum)), at.axes * dashpot_sum,
                 at.axes * (dashpot_moment - cross(at.apart, dashpot_sum))};
  given.master = {zero - given.slave.linear, zero - at.axes * moment, zero - given.slave.dashpot_linear,
                  zero - at.axes * dashpot_moment};
  return failed;
}

}  // namespace sazare::methods::blocks
