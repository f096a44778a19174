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
#include "sazare/methods/blocks/charges/collar.hpp"

namespace sazare::methods::blocks {

/// A part of the axis of a hole, by distances from its collar [m].
struct AxialPart {
  Real from = 0, to = 0;

  Real length() const { return std::max<Real>(0, to - from); }
  /// The share of it that another part covers; a part without length is covered as a whole or not at all.
  Real covered_by(const AxialPart& other) const {
    if (length() == 0) return other.length() > 0 && other.from <= from && from <= other.to ? 1 : 0;
    return AxialPart{std::max(from, other.from), std::min(to, other.to)}.length() / length();
  }
};

struct Charge {
  laws::Jwl gas;
  Real energy = 0;     ///< of the explosive per volume [J/m3]
  Real density = 0;    ///< of the explosive [kg/m3]
  Real velocity = 0;   ///< of the detonation [m/s]
  Real area = 0;       ///< of the explosive, across the hole [m2]
  Real hole_area = 0;  ///< of the hole [m2]
  Collar collar = {};
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
  /// Whether the gas stands beneath the collar.
  bool reaches_collar(Real time) const { return burnt(time).length() > 0 && burnt(time).from <= filled.from; }
};

/// What a charge has become.
struct ChargeState {
  Real pressure = 0;  ///< [Pa]
  Real volume = 0;    ///< of the gas [m3]
  Real released = 0;  ///< energy of what has detonated [J]
  Real work = 0;      ///< done by the gas on the walls [J]
  Real lost = 0;      ///< energy that has left through the collar, and that of the stemming [J]
  Real mass = 0;      ///< of the gas [kg]

  Real energy() const { return std::max<Real>(0, released - work - lost); }  ///< of the gas [J]
};

/// The state of a charge at a time, whose walls have made so much room [m3] and taken so much work [J].
inline ChargeState charge_state(const Charge& charge, const CollarState& collar, Real room, Real work) {
  const Real length = charge.burnt(collar.time).length();
  ChargeState state;
  state.volume = charge.hole_area * (length + std::min(collar.moved, charge.collar.length)) + room;
  state.released = charge.energy * charge.area * length;
  state.work = work;
  state.lost = collar.lost_energy;
  state.mass = std::max<Real>(0, charge.density * charge.area * length - collar.lost_mass);
  const Real explosive = state.mass / charge.density;  // that the gas was [m3]
  if (explosive > 0 && state.volume > 0)
    state.pressure = std::max<Real>(0, laws::jwl_pressure(charge.gas, state.volume / explosive, state.energy() / explosive));
  return state;
}

}  // namespace sazare::methods::blocks
