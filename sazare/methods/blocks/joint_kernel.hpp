#pragma once

/// The force of a bonded face, in every lane. `Law` is a type of the list laws::JointLaws.
///
///     d = E^T (x_j + R_j b - x_i) - a       relative displacement of the slave's vertex in face axes
///     E = R_i Q                             face axes: normal out of the master, two tangents
///     f = -A s(d_n) n - A k_s (d_t - u_0)
///     g = -A c_n v_n n - A c_s v_t
///
/// x, R place and rotation of master i and slave j; a, b the vertex in face axes of the master and in the slave's body
/// frame; u_0 its slip; A a third of the face [m2]. The springs' force f acts at the one point x_j + R_j b on both bodies, so it
/// derives from a potential and conserves linear and angular momentum exactly. The dashpots' g acts at the middle of the three
/// points, with the moment that it has about there for vertices that lie in the face as they did at first: that is a dashpot
/// too, keeps the momenta as exactly, and differs from three at the points by the share that displacements have of a face's size.
/// Those of natural joints act at the points, see `limit_dashpots`. Everything is worked out in face axes and turned to world
/// axes once. [Konno2018], 2.1, figs. 1 and 2.

#include "sazare/levels/terms/lane_slots.hpp"
#include "sazare/methods/blocks/joint_dilation.hpp"
#include "sazare/methods/blocks/joint_opening_softening.hpp"
#include "sazare/methods/blocks/joint_slip_softening.hpp"

namespace sazare::methods::blocks {

/// Action and reaction in world axes: the master is the first body.
struct JointForce {
  terms::LanePairForce total, dashpots;
};

/// Sums over the vertices of forces and of their moments about the master's centre, in face axes.
struct FaceSums {
  LaneVector force, moment;

  static FaceSums of(const LaneVector& point, const LaneVector& at_point) { return {at_point, cross(point, at_point)}; }
  void add(const LaneVector& point, const LaneVector& at_point) {
    force = force + at_point;
    moment = add_cross(point, at_point, moment);
  }
  friend FaceSums operator+(const FaceSums& a, const FaceSums& b) { return {a.force + b.force, a.moment + b.moment}; }
};

/// Forces of the springs of the vertices on the slave [N], once the memory is what it must be.
template <class Law>
std::array<LaneVector, vertex_count> spring_forces(const JointParameters<Law, Lanes>& kind, FaceGeometry& at, LaneMask& failed,
                                                   JointChange& change) {
  const LaneVector peak_before = at.peak;
  LaneMask softened{};
  if constexpr (!laws::DilatesBySlip<Law>) softened = raise_peaks(at);
  LaneVector stress = tension_stress(kind, at);
  LaneVector strength;
  LaneMask changes = softened | parts(kind, at);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto i = static_cast<int>(v);
    strength[i] = strength_at(kind, at, stress, i);
    changes |= slips(kind.shear, laws::Slip<Lanes>{{at.shear[v][0], at.shear[v][1]}, {}, {}}, strength[i]);
  }
  failed = LaneMask{};
  change.has_happened = any(changes);
  if (change.has_happened) failed = change_joints(kind, peak_before, strength, softened, stress, at, change);
  if constexpr (laws::DilatesBySlip<Law>) note_stress(kind, stress, at);
  const Lanes area = select(failed, Lanes{}, -at.vertex_area), shear_area = area * kind.shear.stiffness;
  const auto force = [&](std::size_t v) {
    return LaneVector{{area * stress[static_cast<int>(v)], shear_area * at.shear[v][0], shear_area * at.shear[v][1]}};
  };
  return {force(0), force(1), force(2)};
}

template <class Law>
FaceSums springs(const JointParameters<Law, Lanes>& kind, FaceGeometry& at, LaneMask& failed, JointChange& change) {
  const auto force = spring_forces(kind, at, failed, change);
  FaceSums sums = FaceSums::of(at.point[0], force[0]);
  for (std::size_t v = 1; v < vertex_count; ++v) sums.add(at.point[v], force[v]);
  return sums;
}

template <class Law>
FaceSums dashpots(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, const LaneMask& without,
                  const state::LaneVelocities& master, const state::LaneVelocities& slave) {
  const LaneVector spin = transposed(at.axes, slave.spin - master.spin);
  const LaneVector velocity = transposed(at.axes, add_cross(at.between, slave.spin, slave.velocity - master.velocity));
  const Lanes minus = select(without, Lanes{}, broadcast(-1));
  const Lanes across = minus * kind.normal_damping, along = minus * kind.shear_damping;
  const LaneVector sum = at.point[0] + at.point[1] + at.point[2], swept = cross(spin, sum);
  const Lanes across_area = across * at.vertex_area, along_area = along * at.vertex_area;
  const LaneVector thrice = add_product(broadcast(vertex_count), velocity, swept);
  const LaneVector force{{across_area * thrice[0], along_area * thrice[1], along_area * thrice[2]}};
  const auto& [yy, zz, yz] = at.spread;
  const LaneVector about_middle{
      {along * ((yy + zz) * spin[0]), across * (zz * spin[1] - yz * spin[2]), across * (yy * spin[2] - yz * spin[1])}};
  return {force, add_product(broadcast(1.0 / vertex_count), cross(sum, force), about_middle)};
}

/// Those of natural joints, which act at the vertices: friction bounds what each bears.
template <laws::DilatesBySlip Law>
FaceSums dashpots(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, const LaneMask& without,
                  const state::LaneVelocities& master, const state::LaneVelocities& slave) {
  const LaneVector spin = transposed(at.axes, slave.spin - master.spin);
  const LaneVector velocity = transposed(at.axes, add_cross(at.between, slave.spin, slave.velocity - master.velocity));
  const Lanes minus = select(without, Lanes{}, -at.vertex_area);
  FaceSums sums{};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const LaneVector speed = add_cross(spin, at.point[v], velocity);
    LaneVector force{
        {minus * kind.normal_damping * speed[0], minus * kind.shear_damping * speed[1], minus * kind.shear_damping * speed[2]}};
    limit_dashpots(kind, at, v, force);
    sums.add(at.point[v], force);
  }
  return sums;
}

/// From face axes to world axes, and from the master's centre to the pole, from which that centre is given.
inline terms::LanePairForce face_force(const FaceGeometry& at, const LaneVector& centre, const FaceSums& sums) {
  const LaneVector force = at.axes * sums.force;
  return {force, add_cross(centre, force, at.axes * sums.moment)};
}

/// Evaluates joints where their faces are; `failed` tells which have. A face that fails has no force any more.
template <class Law>
JointForce evaluate(FaceGeometry& at, const JointParameters<Law, Lanes>& kind,
                    const LanePointers<const state::Motion<3>>& masters, const LanePointers<const state::Motion<3>>& slaves,
                    const Vector3& pole, LaneMask& failed, JointChange& change) {
  const FaceSums held = springs(kind, at, failed, change);
  const FaceSums damped = dashpots(kind, at, failed, state::load_velocities(masters), state::load_velocities(slaves));
  const LaneVector centre = at.master - broadcast(pole);
  return {face_force(at, centre, held + damped), face_force(at, centre, damped)};
}

}  // namespace sazare::methods::blocks
