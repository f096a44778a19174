#pragma once

/// Motion of single spheres: the step of some that stand one after the other in memory.

#include <algorithm>
#include <cmath>
#include <span>

#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

/// The largest speeds of some spheres, seen from a drift, and not.
struct SphereSpeeds {
  Real first = 0, second = 0;  ///< the two largest, seen from the drift [m/s]
  Real largest = 0;            ///< [m/s]

  /// Takes more speeds in; one that is no number stays.
  void take(const SphereSpeeds& more) {
    second = std::max({second, std::min(first, more.first), more.second});
    first = std::isnan(first) || more.first <= first ? first : more.first;
    largest = std::max(largest, more.largest);
  }
};

/// The flight of spheres of one active level.
struct SphereFlight {
  Real step = 0;                      ///< [s]
  Vector3 gravity = Vector3::Zero();  ///< [m/s2]
  Vector3 drift = Vector3::Zero();    ///< from which speeds are seen [m/s]
};

/// Kicks spheres begin .. end - 1 by their loads, of which the first belongs to `begin` and which become zero, moves them and
/// predicts their velocities.
SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, state::SphereLoad* loads,
                            const SphereFlight& flight);

/// Loads of one time level on spheres of one active level, and for how long they act.
struct TimedLoads {
  const state::SphereLoad* loads = nullptr;  ///< of the first of the spheres and those behind it
  Real given = 0;                            ///< by this kick; 0 where the level is not due [s]
  Real predicted = 0;                        ///< given besides until the next kick; below 0 what they have too much [s]
};

/// Kicks and drifts spheres of one active level whose loads are those of several levels, which stay.
SphereSpeeds kick_and_drift(state::Spheres& spheres, std::size_t begin, std::size_t end, std::span<const TimedLoads> loads,
                            const SphereFlight& flight);

/// Turns spheres begin .. end - 1 by the spin of a step. The angle is 2 atan(|w| h/2) (Cayley), which is |w| h to the second
/// order and, for spheres, the exact course of a kinetic energy a little different, so that the step stays symplectic.
void turn(state::Spheres& spheres, std::size_t begin, std::size_t end, Real step);

/// What held spheres that move bring in in a step, against the loads on them [J]. Added up by so many as are deferred together,
/// so that the sums of parts which are cut between these add up to the same bits.
Real work_of_driven(const state::Spheres& spheres, std::size_t begin, std::size_t end, const state::SphereLoad* loads, Real step);

}  // namespace sazare::methods::spheres
