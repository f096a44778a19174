#pragma once

/// What holds, moves and loads the nodes of a body.

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "sazare/geometry/element_mesh.hpp"
#include "sazare/laws/base_motion.hpp"
#include "sazare/laws/ground_motion.hpp"
#include "sazare/methods/fem/inclined_waves/incident_wave.hpp"
#include "sazare/methods/fem/node_pattern.hpp"

namespace sazare::methods::fem {

/// A degree of freedom that does not move, or moves as a motion says.
struct Support {
  static constexpr Index no_motion = -1;

  Index node = 0;
  int axis = 0;
  Index motion = no_motion;
  Index boundary = 0;  ///< of the case
};

/// A viscous boundary: -c (v - 2 v_in) on its nodes, besides what the ground beyond carries at rest; half of it lets waves leave,
/// the other half brings in the wave that would stand alone in the ground beyond. Lysmer and Kuhlemeyer (1969).
struct ViscousFace {
  std::vector<Index> nodes;
  Eigen::MatrixXd impedance;  ///< c by node and axis [N s/m]
};

template <int D>
struct ViscousBoundary {
  Index boundary = 0;  ///< of the case
  std::vector<geometry::MeshElement> surface;  ///< the faces of the body
  std::vector<ViscousFace> faces;              ///< c of the same faces
  std::vector<Index> nodes;     ///< whose force at rest is this boundary's
  std::array<Index, D> motion;  ///< v_in by axis, or Support::no_motion
};

template <int D>
struct SoilColumn;

/// A side that is not there in nature. The layers along it, without end, move as a column of their own, which the body does not
/// feel. The side feels  s n - c (v - v_c)  with the column's change of stress s and velocity v_c, besides what it carries at
/// rest.
template <int D>
struct FreeFieldSide {
  Index boundary = 0;                          ///< of the case
  int across = 0;                              ///< axis normal to the side
  Real outwards = 1;                           ///< 1 or -1 along that axis
  std::vector<geometry::MeshElement> surface;  ///< the faces of the body
  std::vector<ViscousFace> faces;              ///< c of the same faces
  std::vector<Index> nodes;                    ///< held across the side at rest
  std::vector<std::vector<Index>> levels;      ///< nodes of the side at the elevation of each node of the column
  std::shared_ptr<SoilColumn<D>> column;
};

/// Forces on nodes that grow linearly to their full value within the ramp.
struct Load {
  std::string name;
  NodalColumn force;  ///< [N]
  Real ramp = 0;      ///< [s]

  /// The share of the full value. Without a ramp a load acts in full from t = 0; a static run brings it to bear in its first step.
  Real share(Real time) const { return ramp > 0 && time < ramp ? std::max(time, Real{0}) / ramp : 1; }
};

/// A matrix of mass of the nodes of a face.
struct FaceMass {
  std::vector<Index> nodes;
  Eigen::MatrixXd mass;  ///< by node and axis [kg]
};

/// Still water on faces of the body, or in a joint, where it presses on both sides.
template <int D>
struct StillWater {
  Load pressure;                        ///< on all nodes
  Vector<D> force = Vector<D>::Zero();  ///< of the full pressure on the body; of a joint, on the first side [N]
  Real wet_area = 0;                    ///< [m2; m in 2-D]
  std::vector<FaceMass> moving;         ///< water that moves with the faces

  /// Of all faces, each across itself [kg; kg/m in 2-D].
  Real moving_mass() const {
    Real sum = 0;
    for (const FaceMass& face : moving)
      for (Eigen::Index row = 0; row < face.mass.rows(); ++row)
        for (Eigen::Index column = row % D; column < face.mass.cols(); column += D) sum += face.mass(row, column);
    return sum;
  }
};

template <int D>
struct Supports {
  std::vector<laws::GroundMotion> motions;
  std::vector<Support> held;
  std::vector<ViscousBoundary<D>> viscous;
  std::vector<FreeFieldSide<D>> sides;
  std::optional<IncidentWave> wave;  ///< at an angle, through all viscous boundaries and free-field sides
  std::vector<Index> clamped;  ///< nodes that do not turn, where beams meet them
  std::vector<Load> loads;
  std::vector<StillWater<D>> waters;
  std::vector<std::pair<Index, Index>> tied;  ///< nodes, each with the one whose displacement it has; that one has no other
  std::vector<Index> drained;             ///< nodes at which the excess pore pressure is 0
  Vector<D> gravity = Vector<D>::Zero();  ///< [m/s2]
  laws::BaseMotion base;                  ///< relative to which damping in proportion to the mass acts

  /// Takes the motion of the supports along each axis for that of the base, where it is one.
  void find_base() {
    for (const Support& support : held) base.add_support(support.axis, support.motion);
  }
};

}  // namespace sazare::methods::fem
