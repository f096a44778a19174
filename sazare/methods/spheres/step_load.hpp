#pragma once

/// How much of what is stable a step takes, by the springs and dashpots of the contacts that bodies have.
///
/// With the matrices K and C of a body's contacts, whose other bodies all move against it, the scheme is stable where the largest
/// eigenvalue of
///
///     M^-1 (h^2 K + 4 h C)/4
///
/// is below 1: the load of the body. h is the step [s], M has the mass and the inertia of the body. The sum over two moving bodies
/// of a contact is at most twice that of each alone, so that their blocks of K and C count double; those of walls and of held
/// bodies count once. The bound is never below the truth, and about it where neighbours do move against each other.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sazare/methods/spheres/contact_table.hpp"
#include "sazare/state/clumps.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

/// A contact of two spheres, or of one and a wall.
struct ContactPoint {
  std::size_t first = 0, second = 0;  ///< places of the spheres; the second is not read at a wall
  Index wall_material = no_wall;
  Vector3 normal = Vector3::Zero();  ///< from the first to the second, or to the wall
  Real overlap = 0;                  ///< [m]
  Real step = 0;                     ///< [s]

  static constexpr Index no_wall = -1;
  bool is_at_wall() const { return wall_material != no_wall; }
};
/// Calls a function for every contact, in an order that does not depend on threads.
using ContactVisit = std::function<void(const std::function<void(const ContactPoint&)>&)>;

struct StepLoad {
  Real load = 0;     ///< of the body that has the largest one; above 1 the step may be unstable
  Index sphere = -1;  ///< number of a sphere of it; below 0 where nothing touches
};

/// What bodies are: `clump_of` says by place which clump a sphere is of, below 0 where of none; empty without clumps.
struct LoadedBodies {
  const state::Spheres& spheres;
  const state::Clumps& clumps;
  std::span<const Index> clump_of;
  /// Whether a body is to be looked at, by the place of one of its spheres; without one all are.
  std::function<bool(std::size_t sphere)> is_own = {};
  std::span<const Index> place = {};  ///< by number, where the spheres stand; needed with both
};

/// The load of a body, and what singled it out.
struct HeavyLoad {
  Real sum = 0;  ///< of its contacts, which no load exceeds
  StepLoad of = {};
};

/// The loads of the bodies that the sums of their contacts single out, at most some hundred.
std::vector<HeavyLoad> heaviest_loads(const LoadedBodies& bodies, const ContactTable& table, const ContactVisit& visit);
/// The largest one of those that are singled out of all; the lists of parts of the bodies may be joined before.
StepLoad largest_step_load(std::vector<HeavyLoad> loads);

}  // namespace sazare::methods::spheres
