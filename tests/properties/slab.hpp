#pragma once

/// The blast of cases/free-face-blast, short: the charge is full at the beginning, so that joints break within tens of
/// microseconds.

#include <string>
#include <vector>

#include "tests/support/blocks_scene.hpp"

namespace sazare::test {

struct SlabRules {
  cases::Limiter limiter = cases::Limiter::stability;
  cases::Levels levels = cases::Levels::per_element;
  bool takes_springs_from_elements = false;  ///< by Young's modulus and Poisson's ratio, with joints that soften by slip as well
  cases::ContactShape contact = cases::ContactShape::spheres;
  bool deformable = false;  ///< elements, which then take their springs from themselves too
};

/// Not started. The mesh is that of the case.
runs::BlocksModel slab(const SlabRules& rules = {});

/// The levels of all bodies, positions, velocities and rotations, states of joints, balance and counters, as bytes.
std::string fingerprint(const runs::BlocksModel& model);

void advance(runs::BlocksModel& model, int base_steps);

/// Lowest and highest level in use.
std::pair<int, int> levels_in_use(const runs::BlocksModel& model);

}  // namespace sazare::test
