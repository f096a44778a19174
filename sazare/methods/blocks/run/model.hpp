#pragma once

/// From a checked case and its mesh to a simulation.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sazare/geometry/face_map.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/levels/terms/outside_forces.hpp"
#include "sazare/methods/blocks/block_contacts.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/charges/charge_gas.hpp"
#include "sazare/methods/blocks/deformation/elements.hpp"
#include "sazare/methods/blocks/joints.hpp"
#include "sazare/methods/blocks/outer_faces.hpp"
#include "sazare/methods/blocks/run/joints/strength_scatter.hpp"
#include "sazare/methods/blocks/run/mesh_fit.hpp"
#include "sazare/methods/blocks/surface_contacts.hpp"
#include "sazare/methods/blocks/water/water_loads.hpp"
#include "sazare/runs/run_clocks.hpp"

namespace sazare::runs {

/// A simulation and what is needed to read its results.
struct BlocksModel {
  geometry::TetraMesh mesh;
  std::vector<Index> material;             ///< by element
  std::vector<Real> stable_step;           ///< by element at the beginning, the fraction of the case not yet applied [s]
  MeshFit fit;
  CaseKinds kinds;                         ///< of joints
  std::vector<bool> is_bound_by_dashpots;  ///< by element: what the larger part of that step's bound comes from
  std::unique_ptr<levels::Simulation<3>> simulation;
  methods::blocks::Joints* joints = nullptr;            ///< owned by the simulation
  methods::blocks::Elements* elements = nullptr;        ///< none where all are rigid; owned by the simulation
  methods::blocks::BlockContacts* contacts = nullptr;   ///< owned by the simulation
  methods::blocks::OuterFaces* boundaries = nullptr;    ///< none where no face has a boundary; owned by the simulation
  methods::blocks::ChargeGas* charges = nullptr;        ///< none where no charge stands at a face; owned by the simulation
  methods::blocks::SurfaceContacts* surface = nullptr;  ///< of a coupling; owned by the simulation
  methods::blocks::WaterLoads* water = nullptr;         ///< none without water; owned by the simulation
  terms::OutsideForces* outside_forces = nullptr;       ///< none in a run that takes none; owned by the simulation
  std::vector<Vector3> equilibrium;  ///< centres of the elements when time began; none where they did not settle before [m]

  /// From where displacements count: centres of the elements when time began [m].
  const std::vector<Vector3>& places_at_start() const { return equilibrium.empty() ? simulation->bodies().start : equilibrium; }
};

/// What a model is made for.
struct BlocksSetting {
  levels::Sharing sharing = {};
  std::optional<Real> window = std::nullopt;  ///< of a coupling [s]: a base step that the case does not give divides it
  bool takes_forces = false;                  ///< from outside
};

/// Throws UserError when the case does not fit its mesh in a way only the faces show. In a coupling there is a surface to be
/// attached.
BlocksModel build_blocks(const cases::BlocksCase& blocks, geometry::TetraMesh mesh, const BlocksSetting& setting = {});

/// Forces on all elements, and moments about their centres or none, from the present base step on. Within a base step nothing is
/// taken over: those of its beginning act to its end.
void apply_forces(BlocksModel& model, std::span<const Vector3> forces, std::span<const Vector3> moments);

/// The clocks of a case in base steps [s].
inline RunClocks clocks_of(const cases::Time& time, Real base_step) {
  return make_clocks({time.end, time.history_interval, time.snapshot_interval}, "base_step", base_step);
}

}  // namespace sazare::runs
