#pragma once

/// The steps of the spheres of a case.

#include <cstdint>
#include <optional>
#include <vector>

#include "sazare/methods/spheres/bonds.hpp"
#include "sazare/methods/spheres/run/placing/placement.hpp"

namespace sazare::runs {

struct SphereSteps {
  Real limit = 0;                   ///< of the step of the sphere that bears least [s]
  Real step = 0;                    ///< of all; with levels the base step [s]
  std::vector<std::int8_t> level;   ///< by number of the sphere: it steps step / 2^level; empty: all take one step
  std::vector<std::int64_t> count;  ///< spheres by level
  Real particle_steps = 0;          ///< steps of single spheres in a step, with levels about
  Real share_of_uniform = 1;        ///< of those that one step for all takes in the same time

  Real smallest() const;
};

/// What limits the steps of spheres that are placed.
struct SphereStepLimits {
  const methods::spheres::ContactTable& contacts;
  const methods::spheres::Bonds& bonds;
};

/// A step that the case does not give divides its history interval; with a `window` it divides that, and all take one step [s].
/// Throws UserError when the step of the case is above the limit, or levels are asked for within windows.
SphereSteps choose_steps(const cases::CaseFile& file, const Placement& placement, const SphereStepLimits& limits,
                         std::optional<Real> window);

}  // namespace sazare::runs
