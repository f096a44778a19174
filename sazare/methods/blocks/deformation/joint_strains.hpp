#pragma once

/// What strains of the two elements beside a bonded face do to it, and it to them, in every lane.
///
///     d = E^T (x_j + R_j (1 + S_j) b - x_i) - Q^T (1 + S_i) Q a - u_0      S_i, S_j  strains of master and slave; else as in
///     joint_kernel.hpp
///
/// The force F of a vertex on the slave, springs and dashpot, does work on its strain through (1 + S_j) b and on the master's
/// through (1 + S_i) Q a: the symmetric parts of R_j^T F b^T and of -Q E^T F (Q a)^T, each in the body frame. As the
/// springs' potential depends on strains through d alone, these are its derivatives. Each vertex has its own dashpot.

#include <algorithm>

#include "sazare/levels/terms/lane_strain_forces.hpp"
#include "sazare/methods/blocks/deformation/lane_strains.hpp"
#include "sazare/methods/blocks/joint_kernel.hpp"

namespace sazare::methods::blocks {

/// Adds a force times a place, made symmetric.
inline void add_force(LaneSix& sum, const LaneVector& force, const LaneVector& place) {
  constexpr Real share = 1 / root_of_two;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const auto own = static_cast<std::size_t>(i);
    sum[own] = add_product(force[i], place[i], sum[own]);
    sum[3 + own] = add_product(broadcast(share), add_product(force[j], place[k], force[k] * place[j]), sum[3 + own]);
  }
}

/// The vertices of a face as points of both its bodies.
struct StrainedFace {
  LaneMatrix frame;                                    ///< Q
  std::array<LaneVector, vertex_count> on_master;      ///< Q a: in the master's body frame [m]
  std::array<LaneVector, vertex_count> on_slave;       ///< b: in the slave's [m]
  std::array<LaneVector, vertex_count> opening_speed;  ///< by strains alone, in face axes [m/s]
};

/// Moves the vertices of a face by the strains of its bodies.
template <class Record>
StrainedFace strain_face(const LaneJoints<Record>& joints, const LanePointers<const MasterCorners>& corners,
                         const LaneStrain& master, const LaneStrain& slave, FaceGeometry& at) {
  StrainedFace face;
  face.frame = joints.frame();
  const auto tail = joints.tail();
  const auto on_master = load_records<12>(corners);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto i = static_cast<int>(v);
    face.on_slave[v] = tail.arm[v];
    face.on_master[v] = {{on_master[3 * v], on_master[3 * v + 1], on_master[3 * v + 2]}};
    const LaneVector by_slave = at.slave_axes * product(slave.strain, face.on_slave[v]);
    const LaneVector moved = by_slave - transposed(face.frame, product(master.strain, face.on_master[v]));
    at.point[v] = at.point[v] + by_slave;
    at.opening[i] += moved[0];
    at.shear[v][0] += moved[1];
    at.shear[v][1] += moved[2];
    face.opening_speed[v] =
        at.slave_axes * product(slave.rate, face.on_slave[v]) - transposed(face.frame, product(master.rate, face.on_master[v]));
  }
  return face;
}

/// Forces of the vertices on the slave, in face axes [N].
using VertexForces = std::array<LaneVector, vertex_count>;

template <class Law>
VertexForces vertex_dashpots(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, const StrainedFace& face,
                             const LaneMask& without, const state::LaneVelocities& master, const state::LaneVelocities& slave) {
  const LaneVector spin = transposed(at.axes, slave.spin - master.spin);
  const LaneVector velocity = transposed(at.axes, add_cross(at.between, slave.spin, slave.velocity - master.velocity));
  const Lanes minus = select(without, Lanes{}, -at.vertex_area);
  const Lanes across = minus * kind.normal_damping, along = minus * kind.shear_damping;
  VertexForces forces;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const LaneVector speed = add_cross(spin, at.point[v], velocity + face.opening_speed[v]);
    forces[v] = {{across * speed[0], along * speed[1], along * speed[2]}};
    if constexpr (laws::DilatesBySlip<Law>) limit_dashpots(kind, at, v, forces[v]);
  }
  return forces;
}

inline FaceSums sums_of(const FaceGeometry& at, const VertexForces& forces) {
  FaceSums sums = FaceSums::of(at.point[0], forces[0]);
  for (std::size_t v = 1; v < vertex_count; ++v) sums.add(at.point[v], forces[v]);
  return sums;
}

/// On the strains of master and slave.
struct LaneStrainForces {
  LaneSix master = {}, slave = {};
};

inline LaneStrainForces strain_forces(const FaceGeometry& at, const StrainedFace& face, const VertexForces& forces) {
  LaneStrainForces sum;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    add_force(sum.slave, transposed(at.slave_axes, forces[v]), face.on_slave[v]);
    add_force(sum.master, -(face.frame * forces[v]), face.on_master[v]);
  }
  return sum;
}

inline terms::LaneStrainNumbers side_by_side(const LaneStrainForces& forces) {
  terms::LaneStrainNumbers numbers;
  std::ranges::copy(forces.master, numbers.begin());
  std::ranges::copy(forces.slave, numbers.begin() + 6);
  return numbers;
}

/// What strained joints give beside what rigid ones do.
struct StrainedJointForce {
  JointForce force;
  LaneStrainForces total, dashpots;
};

/// As `evaluate` of rigid bodies, with what strains do at the faces.
template <class Law>
StrainedJointForce evaluate_strained(FaceGeometry& at, const StrainedFace& face, const JointParameters<Law, Lanes>& kind,
                                     const LanePointers<const state::Motion<3>>& masters,
                                     const LanePointers<const state::Motion<3>>& slaves, const Vector3& pole, LaneMask& failed,
                                     JointChange& change) {
  VertexForces total = spring_forces(kind, at, failed, change);
  const VertexForces damped =
      vertex_dashpots(kind, at, face, failed, state::load_velocities(masters), state::load_velocities(slaves));
  for (std::size_t v = 0; v < vertex_count; ++v) total[v] = total[v] + damped[v];
  const LaneVector centre = at.master - broadcast(pole);
  return {{face_force(at, centre, sums_of(at, total)), face_force(at, centre, sums_of(at, damped))},
          strain_forces(at, face, total),
          strain_forces(at, face, damped)};
}

}  // namespace sazare::methods::blocks
