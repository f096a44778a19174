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

/// What the gas does where rock has cracked.
enum class GasInCracks {
  none,   ///< it stays in its hole
  share,  ///< it acts in connected cracks at once, with a share of the pressure of the hole
  flow,   ///< it flows, see crack_flow.hpp
};

struct CrackRules {
  GasInCracks gas = GasInCracks::none;
  Real share = 1;      ///< of the pressure of the hole
  Real aperture = 0;   ///< that a crack has more than its faces are apart, also where it is closed [m]
  Real discharge = 1;  ///< of openings, see FlowingGas
};

struct Charge {
  laws::Jwl gas;
  Real energy = 0;     ///< of the explosive per volume [J/m3]
  Real density = 0;    ///< of the explosive [kg/m3]
  Real velocity = 0;   ///< of the detonation [m/s]
  Real area = 0;       ///< of the explosive, across the hole [m2]
  Real hole_area = 0;  ///< of the hole [m2]
  Collar collar = {};
  CrackRules cracks = {};
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

/// What of a charge is in cracks, or was.
struct TakenByCracks {
  Real mass = 0;  ///< that has gone into them [kg]
  Real held = 0;  ///< energy of the gas in them [J]
  Real work = 0;  ///< done on them [J]
  Real lost = 0;  ///< energy that has left through them [J]
  Real room = 0;  ///< that they add to the hole, where gas does not flow [m3]
};

/// What a charge has become.
struct ChargeState {
  Real pressure = 0;  ///< [Pa]
  Real volume = 0;    ///< of the gas in the hole [m3]
  Real released = 0;  ///< energy of what has detonated [J]
  Real work = 0;      ///< done by the gas on the walls and in cracks [J]
  Real lost = 0;      ///< energy that has left through the collar and through cracks, and that of the stemming [J]
  Real in_cracks = 0;  ///< energy of the gas in cracks [J]
  Real mass = 0;       ///< of the gas in the hole [kg]

  Real energy() const { return std::max<Real>(0, released - work - lost - in_cracks); }  ///< of the gas in the hole [J]
};

/// The state of a charge at a time, whose walls have made so much room [m3] and taken so much work [J].
inline ChargeState charge_state(const Charge& charge, const CollarState& collar, const TakenByCracks& cracks, Real room,
                                Real work) {
  const Real length = charge.burnt(collar.time).length();
  ChargeState state;
  state.volume = charge.hole_area * (length + std::min(collar.moved, charge.collar.length)) + room + cracks.room;
  state.released = charge.energy * charge.area * length;
  state.work = work + cracks.work;
  state.lost = collar.lost_energy + cracks.lost;
  state.in_cracks = cracks.held;
  state.mass = std::max<Real>(0, charge.density * charge.area * length - collar.lost_mass - cracks.mass);
  const Real explosive = state.mass / charge.density;  // that the gas was [m3]
  if (explosive > 0 && state.volume > 0)
    state.pressure = std::max<Real>(0, laws::jwl_pressure(charge.gas, state.volume / explosive, state.energy() / explosive));
  return state;
}

}  // namespace sazare::methods::blocks
