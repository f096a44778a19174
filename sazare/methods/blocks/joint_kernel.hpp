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
/// Everything is worked out in face axes and turned to world axes once. [Konno2018], 2.1, figs. 1 and 2.

#include "sazare/levels/terms/lane_slots.hpp"
#include "sazare/methods/blocks/joint_kinds.hpp"
#include "sazare/state/body_lanes.hpp"

namespace sazare::methods::blocks {

/// Vertices in face axes, and what their joints remember.
struct FaceGeometry {
  LaneMatrix axes;                                       ///< E
  LaneVector master;                                     ///< x_i [m]
  LaneVector between;                                    ///< x_j - x_i in world axes [m]
  LaneVector apart;                                      ///< and in face axes
  std::array<LaneVector, vertex_count> point;            ///< from the master's centre [m]
  LaneVector opening;                                    ///< d_n, by vertex [m]
  std::array<std::array<Lanes, 2>, vertex_count> shear;  ///< d_t less the slip so far [m]
  LaneVector peak;
  Lanes vertex_area;
  std::array<Lanes, 3> spread;
};

template <class Record, class Body>
FaceGeometry face_geometry(const LaneJoints<Record>& joints, const LanePointers<Body>& masters,
                           const LanePointers<Body>& slaves) {
  FaceGeometry at;
  const LaneMatrix frame = joints.frame();
  const state::LanePlaces master = state::load_places(masters);
  for (int i = 0; i < 3; ++i) at.axes[i] = master.rotation * frame[i];  // a whole matrix would be copied by a call
  const state::LanePlaces slave = state::load_places(slaves);
  at.master = master.position;
  at.between = slave.position - master.position;
  at.apart = transposed(at.axes, at.between);
  LaneMatrix slave_axes;  // slave's body frame to face axes
  for (int i = 0; i < 3; ++i) slave_axes[i] = transposed(at.axes, slave.rotation[i]);
  const auto tail = joints.tail();
  at.vertex_area = tail.vertex_area;
  at.spread = tail.spread;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    at.point[v] = add_product(slave_axes, tail.arm[v], at.apart);
    const auto vertex = joints.vertex(v);
    const LaneVector displacement = at.point[v] - vertex.corner;
    at.opening[static_cast<int>(v)] = displacement[0];
    at.peak[static_cast<int>(v)] = vertex.peak;
    at.shear[v] = {displacement[1], displacement[2]};
  }
  return at;
}

/// Action and reaction in world axes: the master is the first body.
struct JointForce {
  terms::LanePairForce total, dashpots;
};

/// Whether some joint has softened. Asked once for all vertices: no processor guesses which few have.
template <class Law>
bool some_soften(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at) {
  const auto softens = [&](int v) { return is_softened(kind.tension, at.peak[v]); };
  return any(softens(0) | softens(1) | softens(2));
}

/// Stress [Pa] at every vertex once the memory has been raised to the opening.
template <class Law>
LaneVector tension_stress(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, bool soften) {
  LaneVector stress = kind.tension.stiffness * at.opening;
  if (soften)
    for (int v = 0; v < vertex_count; ++v) stress[v] = softened_stress(kind.tension, at.opening[v], at.peak[v]);
  return stress;
}

/// Recoverable energy [J] under these stresses.
template <class Law>
Lanes elastic_energy(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, const LaneVector& stress) {
  Lanes energy{};
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto [x, y] = at.shear[v];
    const auto i = static_cast<int>(v);
    energy += stored_energy(kind.tension, at.opening[i], stress[i]) + 0.5 * kind.shear.stiffness * (x * x + y * y);
  }
  return energy * at.vertex_area;
}

/// What fracture has taken of faces for good [J].
template <class Law>
Lanes fracture_work(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at) {
  Lanes work{};
  for (int v = 0; v < vertex_count; ++v) work += fracture_dissipation(kind.tension, at.peak[v]);
  return work * at.vertex_area;
}

/// What an evaluation has done to its joints. Few evaluations change any: all else is set only where one has.
struct JointChange {
  bool has_happened;
  LaneMask softened;  ///< the memory of opening has grown
  LaneMask slipped;
  LaneMask failed;                                      ///< a vertex has failed: the whole face comes apart and gives nothing
  Lanes slip_work;                                      ///< energy that slip has taken [J]
  Lanes released;                                       ///< elastic energy of what came apart [J]
  LaneVector peak;                                      ///< the memory of opening as it is now
  std::array<std::array<Lanes, 2>, vertex_count> slip;  ///< what has been added to the slip
};

/// Raises the memory to the present opening.
inline LaneMask raise_peaks(FaceGeometry& at) {
  LaneMask raised{};
  for (int v = 0; v < vertex_count; ++v) {
    raised |= at.opening[v] > at.peak[v];
    at.peak[v] = maximum(at.opening[v], at.peak[v]);
  }
  return raised;
}

/// What is stored in a face that fails is lost.
template <class Law>
void fail(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, const LaneVector& stress, JointChange& change) {
  for (int v = 0; v < vertex_count; ++v) change.failed |= has_failed(kind.tension, at.peak[v]);
  if (any(change.failed)) change.released = select(change.failed, elastic_energy(kind, at, stress), Lanes{});
}

/// Lets the vertices slip that must, in the lanes where one does.
template <class Law>
void slide(const JointParameters<Law, Lanes>& kind, const LaneVector& strength, FaceGeometry& at, JointChange& change) {
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const Lanes limit = strength[static_cast<int>(v)];
    laws::Slip<Lanes> slip{{at.shear[v][0], at.shear[v][1]}, {}, {}};
    change.slipped |= slips(kind.shear, slip, limit);
    slip_back(kind.shear, slip, limit);
    at.shear[v] = {slip.elastic[0], slip.elastic[1]};
    change.slip[v] = {slip.memory[0], slip.memory[1]};
    change.slip_work += select(change.failed, Lanes{}, at.vertex_area * slip.dissipation);
  }
}

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

/// What softens, fails and slips; returns which joints have failed.
template <class Law>
LaneMask change_joints(const JointParameters<Law, Lanes>& kind, const LaneVector& stress, const LaneVector& strength,
                              const LaneMask& softened, FaceGeometry& at, JointChange& change) {
  change.softened = softened;
  change.slipped = change.failed = LaneMask{};
  change.slip_work = change.released = Lanes{};
  change.peak = at.peak;
  fail(kind, at, stress, change);
  slide(kind, strength, at, change);
  return change.failed;
}

/// Springs, once the memory is what it must be.
template <class Law>
FaceSums springs(const JointParameters<Law, Lanes>& kind, FaceGeometry& at, LaneMask& failed, JointChange& change) {
  const LaneMask softened = raise_peaks(at);
  const LaneVector stress = tension_stress(kind, at, some_soften(kind, at));
  LaneVector strength;
  LaneMask changes = softened;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto i = static_cast<int>(v);
    strength[i] = shear_strength(kind.shear, stress[i]);
    changes |= slips(kind.shear, laws::Slip<Lanes>{{at.shear[v][0], at.shear[v][1]}, {}, {}}, strength[i]);
  }
  failed = LaneMask{};
  change.has_happened = any(changes);
  if (change.has_happened) failed = change_joints(kind, stress, strength, softened, at, change);
  const Lanes area = select(failed, Lanes{}, -at.vertex_area), shear_area = area * kind.shear.stiffness;
  const auto force = [&](std::size_t v) {
    return LaneVector{{area * stress[static_cast<int>(v)], shear_area * at.shear[v][0], shear_area * at.shear[v][1]}};
  };
  FaceSums sums = FaceSums::of(at.point[0], force(0));
  for (std::size_t v = 1; v < vertex_count; ++v) sums.add(at.point[v], force(v));
  return sums;
}

template <class Law>
FaceSums dashpots(const JointParameters<Law, Lanes>& kind, const FaceGeometry& at, const LaneMask& failed,
                         const state::LaneVelocities& master, const state::LaneVelocities& slave) {
  const LaneVector spin = transposed(at.axes, slave.spin - master.spin);
  const LaneVector velocity = transposed(at.axes, add_cross(at.between, slave.spin, slave.velocity - master.velocity));
  const Lanes minus = select(failed, Lanes{}, broadcast(-1));
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

/// From face axes to world axes, and from the master's centre to the pole, from which that centre is given.
inline terms::LanePairForce face_force(const FaceGeometry& at, const LaneVector& centre, const FaceSums& sums) {
  const LaneVector force = at.axes * sums.force;
  return {force, add_cross(centre, force, at.axes * sums.moment)};
}

/// Evaluates joints; `failed` tells which have. A face that fails has no force any more.
template <class Law>
JointForce evaluate(const LaneJoints<JointRecord>& joints, const JointParameters<Law, Lanes>& kind,
                           const LanePointers<const state::Motion<3>>& masters,
                           const LanePointers<const state::Motion<3>>& slaves, const Vector3& pole, LaneMask& failed,
                           JointChange& change) {
  FaceGeometry at = face_geometry(joints, masters, slaves);
  const FaceSums held = springs(kind, at, failed, change);
  const FaceSums damped = dashpots(kind, at, failed, state::load_velocities(masters), state::load_velocities(slaves));
  const LaneVector centre = at.master - broadcast(pole);
  return {face_force(at, centre, held + damped), face_force(at, centre, damped)};
}

}  // namespace sazare::methods::blocks
