#pragma once

/// The force of a bonded face, in every lane.
///
///     d = E^T (x_j + R_j b - x_i) - a       relative displacement of the slave's vertex in face axes
///     E = R_i Q                             face axes: normal out of the master, two tangents
///     f = -A (s(d_n) + c_n v_n) n - A (k_s d_t + c_s v_t)
///
/// x, R place and rotation of master i and slave j; a, b the vertex in face axes of the master and in the slave's body
/// frame; A a third of the face [m2]. The force acts at the one point x_j + R_j b on both bodies, so it derives from a
/// potential and conserves linear and angular momentum exactly. Everything is worked out in face axes and turned to
/// world axes once. [Konno2018], 2.1, figs. 1 and 2.

#include <algorithm>

#include "sazare/methods/blocks/joint_record.hpp"
#include "sazare/state/bodies.hpp"

namespace sazare::methods::blocks {

/// Bodies, one in each lane, at one moment; in the order of a motion's numbers, which are never moved once they are read.
struct LaneBodies {
  std::array<Lanes, 20> number;

  LaneVector position() const { return vector(0); }
  LaneMatrix rotation() const { return {{vector(3), vector(6), vector(9)}}; }
  LaneVector velocity() const { return vector(12); }
  LaneVector spin() const { return vector(15); }

private:
  LaneVector vector(std::size_t first) const { return {{number[first], number[first + 1], number[first + 2]}}; }
};

/// Bodies that stand at their own time.
inline LaneBodies load_bodies(const LanePointers<const state::Motion<3>>& bodies) { return {load_records<20>(bodies)}; }

/// Places of bodies, whose velocities are not asked for.
inline LaneBodies load_poses(const LanePointers<const state::Pose<3>>& poses) {
  LaneBodies bodies;
  std::ranges::copy(load_records<12>(poses), bodies.number.begin());
  return bodies;
}

/// Vertices in face axes.
struct FaceGeometry {
  LaneMatrix axes;                                    ///< E
  LaneVector apart;                                   ///< x_j - x_i in face axes [m]
  std::array<LaneVector, vertex_count> point;         ///< from the master's centre [m]
  std::array<LaneVector, vertex_count> displacement;  ///< d [m]
};

inline FaceGeometry face_geometry(const LaneJoints& joints, const LaneBodies& master, const LaneBodies& slave) {
  FaceGeometry at;
  at.axes = master.rotation() * joints.frame;
  at.apart = transposed(at.axes, slave.position() - master.position());
  LaneMatrix slave_axes;  // slave's body frame to face axes
  for (int i = 0; i < 3; ++i) slave_axes[i] = transposed(at.axes, slave.rotation()[i]);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    at.point[v] = slave_axes * joints.arm[v] + at.apart;
    at.displacement[v] = at.point[v] - joints.corner[v];
  }
  return at;
}

/// Action and reaction in world axes: the force on the slave and its moments about both centres.
struct FaceForce {
  LaneVector master_moment, linear, slave_moment;
};
struct JointForce {
  FaceForce total, dashpots;
};

/// Slopes [Pa/m] on which the vertices of joints unload. Few joints have softened.
inline LaneVector unloading_of(const LaneJoints& joints, const JointParameters<Lanes>& kind) {
  LaneVector unloading;
  for (int v = 0; v < vertex_count; ++v)
    unloading[v] = any(joints.peak[v] > kind.tension.elastic_opening) ? laws::unloading_stiffness(kind.tension, joints.peak[v])
                                                                      : kind.tension.stiffness;
  return unloading;
}

/// Recoverable energy [J].
inline Lanes elastic_energy(const LaneJoints& joints, const JointParameters<Lanes>& kind, const FaceGeometry& at) {
  const LaneVector unloading = unloading_of(joints, kind);
  Lanes energy{};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const LaneVector& d = at.displacement[v];
    const Lanes x = d[1] - joints.slip[v][0], y = d[2] - joints.slip[v][1];
    energy +=
        laws::tension_energy(kind.tension, d[0], unloading[static_cast<int>(v)]) + 0.5 * kind.shear.stiffness * (x * x + y * y);
  }
  return energy * joints.vertex_area;
}

/// What an evaluation has done to its joints.
struct JointChange {
  LaneMask softened{};  ///< the memory of opening has grown
  LaneMask slipped{};
  LaneMask failed{};  ///< a vertex has failed: the whole face comes apart and gives nothing
  Lanes slip_work{};  ///< energy that slip has taken [J]
  Lanes released{};   ///< elastic energy of what came apart [J]
};

/// Raises the memory to the present opening; what is stored in a face that fails is lost.
inline void soften(LaneJoints& joints, const JointParameters<Lanes>& kind, const FaceGeometry& at, JointChange& change) {
  for (int v = 0; v < vertex_count; ++v) {
    const Lanes opening = at.displacement[static_cast<std::size_t>(v)][0];
    const LaneMask opens = opening > joints.peak[v];
    joints.peak[v] = select(opens, opening, joints.peak[v]);
    change.softened |= opens;
    change.failed |= joints.peak[v] >= kind.tension.failure_opening;
  }
  if (any(change.failed)) change.released = select(change.failed, elastic_energy(joints, kind, at), Lanes{});
}

/// Elastic shear displacement of a vertex, after it has slipped where it must.
inline std::array<Lanes, 2> shear(LaneJoints& joints, const JointParameters<Lanes>& kind, std::size_t v, const LaneVector& d,
                                  Lanes stress, JointChange& change) {
  auto& slip = joints.slip[v];
  laws::Slip<Lanes> at{{d[1] - slip[0], d[2] - slip[1]}, {slip[0], slip[1]}, {}};
  const Lanes strength = laws::shear_strength(kind.shear, stress);
  const LaneMask slips = laws::slips(kind.shear, at, strength);
  if (any(slips)) {
    laws::slip_back(kind.shear, at, strength);
    slip = {at.memory[0], at.memory[1]};
    change.slip_work += select(change.failed, Lanes{}, joints.vertex_area * at.dissipation);
    change.slipped |= slips;
  }
  return {at.elastic[0], at.elastic[1]};
}

/// Sums over the vertices of forces and of their moments about the master's centre, in face axes.
struct FaceSums {
  LaneVector force, moment;

  void add(const LaneVector& point, const LaneVector& at_point) {
    force = force + at_point;
    moment = moment + cross(point, at_point);
  }
};

/// From face axes to world axes.
inline FaceForce face_force(const FaceGeometry& at, const FaceSums& sums) {
  return {-(at.axes * sums.moment), at.axes * sums.force, at.axes * (sums.moment - cross(at.apart, sums.force))};
}

/// Evaluates joints. A face that fails has no force any more.
inline JointForce evaluate(LaneJoints& joints, const JointParameters<Lanes>& kind, const LaneBodies& master,
                           const LaneBodies& slave, JointChange& change) {
  const FaceGeometry at = face_geometry(joints, master, slave);
  LaneMask opening{};
  for (int v = 0; v < vertex_count; ++v) opening |= at.displacement[static_cast<std::size_t>(v)][0] > joints.peak[v];
  if (any(opening)) soften(joints, kind, at, change);

  const LaneVector slave_spin = transposed(at.axes, slave.spin());
  const LaneVector spin = slave_spin - transposed(at.axes, master.spin());
  const LaneVector velocity = transposed(at.axes, slave.velocity() - master.velocity()) - cross(slave_spin, at.apart);
  const Lanes area = select(change.failed, Lanes{}, -joints.vertex_area);
  const Lanes shear_area = area * kind.shear.stiffness;
  const Lanes across = area * kind.normal_damping, along = area * kind.shear_damping;
  const LaneVector unloading = unloading_of(joints, kind);
  FaceSums all{}, dashpots{};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const LaneVector& d = at.displacement[v];
    const Lanes stress = laws::tension_stress(kind.tension, d[0], unloading[static_cast<int>(v)]);
    const auto elastic = shear(joints, kind, v, d, stress, change);
    const LaneVector speed = velocity + cross(spin, at.point[v]);
    const LaneVector dashpot{{across * speed[0], along * speed[1], along * speed[2]}};
    dashpots.add(at.point[v], dashpot);
    all.add(at.point[v], dashpot + LaneVector{{area * stress, shear_area * elastic[0], shear_area * elastic[1]}});
  }
  return {face_force(at, all), face_force(at, dashpots)};
}

}  // namespace sazare::methods::blocks
