#pragma once

/// Bonded faces in lanes: where their vertices are, what is stored there, and what an evaluation changes.

#include "sazare/methods/blocks/joint_kinds.hpp"
#include "sazare/state/body_lanes.hpp"

namespace sazare::methods::blocks {

/// Vertices in face axes, and what their joints remember.
struct FaceGeometry {
  LaneMatrix axes;                                       ///< E
  LaneVector master;                                     ///< x_i [m]
  LaneVector between;                                    ///< x_j - x_i in world axes [m]
  LaneVector apart;                                      ///< and in face axes
  LaneMatrix slave_axes;                                 ///< from the slave's body frame to face axes
  std::array<LaneVector, vertex_count> point;            ///< from the master's centre [m]
  LaneVector opening;                                    ///< d_n, by vertex [m]
  std::array<std::array<Lanes, 2>, vertex_count> shear;  ///< d_t less the slip so far [m]
  LaneVector peak;
  LaneVector path;                              ///< of slip [m], only where the law remembers it
  std::array<LaneVector, vertex_count> stress;  ///< only of natural joints: as last evaluated, and then as now [Pa]
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
  for (int i = 0; i < 3; ++i) at.slave_axes[i] = transposed(at.axes, slave.rotation[i]);
  const auto tail = joints.tail();
  at.vertex_area = tail.vertex_area;
  at.spread = tail.spread;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    at.point[v] = add_product(at.slave_axes, tail.arm[v], at.apart);
    const auto vertex = joints.vertex(v);
    const LaneVector displacement = at.point[v] - vertex.corner;
    at.opening[static_cast<int>(v)] = displacement[0];
    at.peak[static_cast<int>(v)] = vertex.peak;
    at.shear[v] = {displacement[1], displacement[2]};
  }
  return at;
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

/// What an evaluation has done to its joints. Few evaluations change any: all else is set only where one has.
struct JointChange {
  bool has_happened;
  LaneMask softened;  ///< a memory of what softens has grown
  LaneMask slipped;
  LaneMask failed;                                      ///< a vertex has failed: the whole face comes apart and gives nothing
  Lanes slip_work;                                      ///< energy that slip has taken [J]
  Lanes released;                                       ///< elastic energy of what came apart [J]
  LaneVector peak;                                      ///< the memory of opening as it is now
  std::array<std::array<Lanes, 2>, vertex_count> slip;  ///< what has been added to the slip

  // Only of laws that remember the path of slip:
  LaneMask sheared;         ///< a vertex has lost its strength, under pressure
  Lanes opening_fracture;   ///< what fracture by opening has dissipated [J]
  Lanes shear_fracture;     ///< and by slip [J]
  LaneVector path;          ///< the path of slip as it is now
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

}  // namespace sazare::methods::blocks
