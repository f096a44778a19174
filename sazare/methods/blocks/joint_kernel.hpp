#pragma once

/// One bonded face of two blocks: three contact vertices, worked on together as lanes.
///
///     d = E^T (x_j + R_j b - x_i) - a       relative displacement of the slave's vertex in the master's frame
///     E = R_i Q                             face axes: normal out of the master, two tangents
///     f = -A (s(d_n) + c_n v_n) n - A (k_s d_t + c_s v_t)
///
/// x, R place and rotation of master i and slave j; a, b the vertex in face axes of the master and in the slave's body
/// frame; A a third of the face [m2]. The force acts at the one point x_j + R_j b on both bodies, so it derives from a
/// potential and conserves linear and angular momentum exactly. [Konno2018], 2.1, figs. 1 and 2.

#include "sazare/core/lanes.hpp"
#include "sazare/laws/joint_shear.hpp"
#include "sazare/laws/joint_tension.hpp"
#include "sazare/state/bodies.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::methods::blocks {

enum class JointState : std::int32_t { intact, softening, broken };

/// Strength and stiffness of a kind of joint.
struct JointKind {
  laws::JointTension tension;
  laws::JointShear shear;
  Real normal_damping = 0;  ///< c_n [Pa s/m]
  Real shear_damping = 0;   ///< c_s [Pa s/m]
};

using LaneVector = std::array<Lanes, 3>;

struct alignas(64) Joint {
  LaneVector corner;  ///< a [m]
  LaneVector arm;     ///< b [m]
  std::array<Lanes, 2> slip;  ///< u_0 [m]
  Lanes peak;         ///< largest opening, at least the elastic one [m]
  Lanes unloading;    ///< slope to the origin [Pa/m]
  Matrix3 frame;      ///< Q: face axes in the master's body frame, as columns
  Real vertex_area = 0;  ///< A [m2]
  Real slip_work = 0;    ///< [J]
  Real released = 0;     ///< elastic energy when the face came apart [J]
  Index master = 0;
  Index slave = 0;
  Index kind = 0;
  JointState state = JointState::intact;
};

/// What a joint gives to its slave over the time it acts; the master gets the opposite at the same points.
struct JointImpulse {
  state::Wrench<3> total;    ///< on the slave, about its centre
  state::Wrench<3> dashpot;  ///< part of it
};

/// Displacement in face axes, and the points on which the forces act.
struct JointPlace {
  LaneVector slave_arm;    ///< R_j b, world axes [m]
  LaneVector master_arm;   ///< from the master's centre to the same points [m]
  LaneVector displacement;  ///< d [m]
  Matrix3 axes;            ///< E
};

inline JointPlace place(const Joint& joint, const state::Pose<3>& master, const state::Pose<3>& slave) {
  JointPlace at;
  const Vector3 apart = slave.position - master.position;
  at.axes.noalias() = master.rotation * joint.frame;
  for (int i = 0; i < 3; ++i) {
    const auto c = static_cast<std::size_t>(i);
    at.slave_arm[c] = slave.rotation(i, 0) * joint.arm[0] + slave.rotation(i, 1) * joint.arm[1] +
                      slave.rotation(i, 2) * joint.arm[2];
    at.master_arm[c] = at.slave_arm[c] + apart[i];
  }
  for (int k = 0; k < 3; ++k) {
    const auto c = static_cast<std::size_t>(k);
    at.displacement[c] = at.axes(0, k) * at.master_arm[0] + at.axes(1, k) * at.master_arm[1] +
                         at.axes(2, k) * at.master_arm[2] - joint.corner[c];
  }
  return at;
}

/// Relative velocity of the vertices in face axes [m/s].
inline LaneVector opening_velocity(const JointPlace& at, const state::Motion<3>& master, const state::Motion<3>& slave) {
  const Vector3 apart = slave.velocity - master.velocity;
  const Vector3 &p = slave.spin, &q = master.spin;
  const LaneVector &r = at.slave_arm, &u = at.master_arm;
  const LaneVector world = {apart[0] + (p[1] * r[2] - p[2] * r[1]) - (q[1] * u[2] - q[2] * u[1]),
                            apart[1] + (p[2] * r[0] - p[0] * r[2]) - (q[2] * u[0] - q[0] * u[2]),
                            apart[2] + (p[0] * r[1] - p[1] * r[0]) - (q[0] * u[1] - q[1] * u[0])};
  LaneVector local;
  for (int k = 0; k < 3; ++k)
    local[static_cast<std::size_t>(k)] = at.axes(0, k) * world[0] + at.axes(1, k) * world[1] + at.axes(2, k) * world[2];
  return local;
}

/// Raises the joint's memory to the present opening; says whether a vertex has failed.
inline bool soften(Joint& joint, const laws::JointTension& law, Lanes opening) {
  joint.peak = maximum(opening, joint.peak);
  joint.unloading = laws::unloading_stiffness(law, joint.peak);
  joint.state = JointState::softening;
  return any(joint.peak >= law.failure_opening);
}

/// Sums over the vertices of three quantities, in one fixed order.
inline Vector3 lane_sums(const LaneVector& a) {
  const Lanes low01 = __builtin_shufflevector(a[0], a[1], 0, 4, 2, 6), high01 = __builtin_shufflevector(a[0], a[1], 1, 5, 3, 7);
  const Lanes pair01 = low01 + high01;  // lanes 0+1 of both, lanes 2+3 of both
  return {pair01[0] + pair01[2], pair01[1] + pair01[3], sum(a[2])};
}

/// The wrench about a body's centre of forces given in face axes.
inline state::Wrench<3> to_world(const JointPlace& at, const LaneVector& local) {
  LaneVector f;
  for (int i = 0; i < 3; ++i)
    f[static_cast<std::size_t>(i)] = at.axes(i, 0) * local[0] + at.axes(i, 1) * local[1] + at.axes(i, 2) * local[2];
  const LaneVector& r = at.slave_arm;
  const LaneVector turning = {r[1] * f[2] - r[2] * f[1], r[2] * f[0] - r[0] * f[2], r[0] * f[1] - r[1] * f[0]};
  return {lane_sums(f), lane_sums(turning)};
}

/// Recoverable energy of a joint [J].
inline Real elastic_energy(const Joint& joint, const JointKind& kind, const LaneVector& d) {
  const Lanes x = d[1] - joint.slip[0], y = d[2] - joint.slip[1];
  const Lanes density =
      laws::tension_energy(kind.tension, d[0], joint.unloading) + 0.5 * kind.shear.stiffness * (x * x + y * y);
  return joint.vertex_area * ((density[0] + density[1]) + density[2]);
}

/// Evaluates a joint. Where a vertex fails the whole face comes apart and gives nothing any more: false is returned.
inline bool evaluate(Joint& joint, const JointKind& kind, const JointPlace& at, const LaneVector& velocity, Real acting,
                     JointImpulse& given) {
  const LaneVector& d = at.displacement;
  if (any(d[0] > joint.peak) && soften(joint, kind.tension, d[0])) {
    joint.state = JointState::broken;
    joint.released = elastic_energy(joint, kind, d);
    return false;
  }
  const Lanes stress = laws::tension_stress(kind.tension, d[0], joint.unloading);
  laws::Slip<Lanes> shear{{d[1] - joint.slip[0], d[2] - joint.slip[1]}, {joint.slip[0], joint.slip[1]}, {}};
  const Lanes strength = laws::shear_strength(kind.shear, stress);
  if (laws::slips(kind.shear, shear, strength)) {
    laws::slip_back(kind.shear, shear, strength);
    joint.slip = {shear.memory[0], shear.memory[1]};
    joint.slip_work += joint.vertex_area * ((shear.dissipation[0] + shear.dissipation[1]) + shear.dissipation[2]);
  }
  const Real weight = -joint.vertex_area * acting;
  const Lanes area = {weight, weight, weight, 0};
  const LaneVector dashpot = {area * (kind.normal_damping * velocity[0]), area * (kind.shear_damping * velocity[1]),
                              area * (kind.shear_damping * velocity[2])};
  const LaneVector spring = {area * stress, area * (kind.shear.stiffness * shear.elastic[0]),
                             area * (kind.shear.stiffness * shear.elastic[1])};
  given.dashpot = to_world(at, dashpot);
  given.total = to_world(at, spring);
  given.total += given.dashpot;
  return true;
}

/// The opposite impulse on the master: the same forces at the same points, about the master's centre.
inline state::Wrench<3> reaction(const state::Wrench<3>& on_slave, const Vector3& apart) {
  return {-on_slave.linear, -(on_slave.angular + apart.cross(on_slave.linear))};
}

}  // namespace sazare::methods::blocks
