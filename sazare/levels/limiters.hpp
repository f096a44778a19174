#pragma once

/// What bounds the step of one body: small functions, each from what it limits to seconds.

#include <cmath>
#include <limits>

#include "sazare/core/vector.hpp"
#include "sazare/levels/terms/term.hpp"

namespace sazare::levels {

/// How steps are chosen.
struct StepRules {
  Real base_step = 0;                                          ///< level 0 [s]
  bool uniform = false;                                        ///< all bodies take the finest level that any asks for
  bool stability = true;                                       ///< limit by each body's own springs and dashpots
  Real stability_fraction = 0.5;                               ///< of the limit with the neighbours held
  Real travel_length = std::numeric_limits<Real>::infinity();  ///< largest travel in a step [m]
  int neighbor_levels = 2;                                     ///< largest difference of level between linked bodies
};

/// Largest stable step [s] of a body with its neighbours held, by leapfrog with the dashpot's velocity predicted by the mean of
/// its last two forces (terms/slot.hpp): the positive root of
///
///     w^2 h^2 + 2 c h = 4        w^2, c  largest eigenvalues of M^-1 K [1/s2] and M^-1 C [1/s]
///
/// so 2 / w without dashpots and 2 / c without springs. Where the neighbours move as well, half of it is stable whatever
/// they do: a link's energy |a - b|^2 is at most 2 |a|^2 + 2 |b|^2.
inline Real stable_step(const terms::Rates& rates) {
  if (rates.stiffness <= 0 && rates.damping <= 0) return std::numeric_limits<Real>::infinity();
  const Real half = rates.damping / 2;
  return 2 / (half + std::sqrt(half * half + rates.stiffness));
}

/// Largest speed [m/s] at which a body travels no farther than the rule's length in a step. [Konno2018], 3.1.
inline Real travel_speed(Real step, Real travel_length) { return travel_length / step; }

}  // namespace sazare::levels
