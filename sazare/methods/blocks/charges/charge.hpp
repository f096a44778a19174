#pragma once

/// A charge in a hole: where the detonation is, and what gas it has left behind.
///
/// The front leaves the primer at both sides with the velocity of the detonation, along the axis of the hole. All that it has
/// passed is one body of gas, of one pressure, in the part of the hole that it has passed: gas flows along a hole much faster
/// than rock yields.

#include <algorithm>
#include <limits>

#include "sazare/core/time.hpp"
#include "sazare/laws/jwl.hpp"

namespace sazare::methods::blocks {

/// A part of the axis of a hole, by distances from its collar [m].
struct AxialPart {
  Real from = 0, to = 0;

  Real length() const { return std::max<Real>(0, to - from); }
};

struct Charge {
  laws::Jwl gas;
  Real energy = 0;                                            ///< of the explosive per volume [J/m3]
  Real velocity = 0;                                          ///< of the detonation [m/s]
  Real area = 0;                                              ///< of the explosive, across the hole [m2]
  Real hole_area = 0;                                         ///< of the hole [m2]
  AxialPart filled;                                           ///< with explosive
  Real primer = 0;                                            ///< distance from the collar [m]
  Real delay = 0;                                             ///< when the primer fires [s]
  Real cut_distance = std::numeric_limits<Real>::infinity();  ///< displacement of a face at which the gas leaves it for good [m]

  /// What has detonated by a time [s]. Empty before the primer fires.
  AxialPart burnt(Real time) const {
    const Real run = velocity * (time - delay);
    if (run <= 0) return {primer, primer};
    return {std::max(filled.from, primer - run), std::min(filled.to, primer + run)};
  }
  Real released(Real time) const { return energy * area * burnt(time).length(); }  ///< energy [J]
};

/// What a charge has become.
struct ChargeState {
  Real pressure = 0;  ///< [Pa]
  Real volume = 0;    ///< of the gas [m3]
  Real released = 0;  ///< energy of what has detonated [J]
  Real work = 0;      ///< done by the gas on the walls [J]
};

/// The state of a charge whose walls have made so much room and taken so much work.
inline ChargeState charge_state(const Charge& charge, Real time, Real room, Real work) {
  const Real length = charge.burnt(time).length();
  const Real explosive = charge.area * length;
  ChargeState state{0, charge.hole_area * length + room, charge.energy * explosive, work};
  if (explosive > 0 && state.volume > 0)
    state.pressure =
        std::max<Real>(0, laws::jwl_pressure(charge.gas, state.volume / explosive, (state.released - work) / explosive));
  return state;
}

}  // namespace sazare::methods::blocks
