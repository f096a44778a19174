#pragma once

/// From a checked case of method spheres to spheres that can be stepped.

#include <memory>
#include <optional>
#include <string>

#include "sazare/methods/spheres/run/steps.hpp"
#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::runs {

struct SpheresModel {
  std::vector<Index> group;     ///< by number of the sphere
  std::vector<Index> body;      ///< by number of the sphere: its clump, below 0 where none
  std::vector<Vector3> placed;  ///< by number of the sphere, where its group puts it [m]; empty without bonded bodies
  std::vector<Real> density;    ///< by material [kg/m3]; empty without bonded bodies
  std::int64_t bonds = 0;       ///< at the start
  std::int64_t clumps = 0;
  Real share_error = 0;  ///< what the inertia of bonded bodies lacks of that of their shapes, relative
  std::vector<ShapeVolume> shapes;
  std::uint64_t start = 0;  ///< hash of where everything stands at the start
  SphereSteps steps;
  std::vector<Index> case_wall;         ///< by wall of the stepper: which of the case; a box has six
  std::vector<std::string> wall_notes;  ///< what is to be told of walls of triangles
  std::unique_ptr<methods::spheres::SphereStepper> stepper;
};

/// Throws UserError when the case does not fit its spheres or its step is above the limit. `window`: see
/// `choose_steps`.
SpheresModel build_spheres(const cases::CaseFile& file, std::optional<Real> window = std::nullopt);

/// The constants of every pair of materials of a case.
methods::spheres::ContactTable contact_table(const cases::SpheresCase& spheres);

}  // namespace sazare::runs
