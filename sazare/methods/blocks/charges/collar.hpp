#pragma once

/// What happens at the collar of a hole: the gas pushes the stemming out, and then leaves after it.
///
/// The stemming is one plug, which moves by the pressure beneath it against its inertia and a shear resistance of the wall along
/// what of it is still in the hole. When it is out, or where there is none, gas leaves through the hole with the velocity of
/// sound (choked flow of a gas of exponent k, into no pressure):
///
///     dm/dt = -S (k p m/V)^1/2 (2/(k + 1))^((k + 1)/(2 (k - 1)))     S  area of the hole;  m, V, p  mass, volume, pressure of
///     the gas
///
/// and takes its enthalpy (E + p V)/m with it, E its energy.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sazare/core/time.hpp"

namespace sazare::methods::blocks {

struct Collar {
  bool vents = false;   ///< else it is closed for ever
  Real area = 0;        ///< of the hole, or of the part of it that the mesh has [m2]
  Real diameter = 0;    ///< of the hole [m]
  Real length = 0;      ///< of the stemming [m]
  Real density = 0;     ///< of the stemming [kg/m3]
  Real resistance = 0;  ///< of the wall against its sliding [Pa]
};

/// Gas beneath a collar.
struct CollarGas {
  Real pressure = 0;  ///< [Pa]
  Real volume = 0;    ///< [m3]
  Real energy = 0;    ///< [J]
  Real mass = 0;      ///< [kg]
  Real exponent = 0;  ///< k [-]

  /// Mass that leaves through an open hole [kg/s].
  Real outflow(Real area) const {
    const Real k = exponent;
    return volume > 0 ? area * std::sqrt(k * pressure * mass / volume) * std::pow(2 / (k + 1), (k + 1) / (2 * (k - 1))) : 0;
  }
  Real enthalpy() const { return mass > 0 ? (energy + pressure * volume) / mass : 0; }  ///< per mass [J/kg]
};

/// Where the stemming is, and what has left, at a time; with their rates.
struct CollarState {
  Real time = 0;         ///< [s]
  Real moved = 0;        ///< of the stemming [m]
  Real velocity = 0;     ///< of the stemming [m/s]
  Real lost_mass = 0;    ///< [kg]
  Real mass_rate = 0;    ///< [kg/s]
  Real lost_energy = 0;  ///< with the gas, and given to the stemming [J]
  Real energy_rate = 0;  ///< [W]
  Real pressure = 0;     ///< beneath it [Pa]

  bool is_open(const Collar& collar) const { return collar.vents && moved >= collar.length; }

  /// A little later, by its rates.
  CollarState at(Real later) const {
    CollarState state = *this;
    const Real span = later - time;
    state.time = later;
    state.moved += span * velocity;
    state.lost_mass += span * mass_rate;
    state.lost_energy += span * energy_rate;
    return state;
  }
};

/// Acceleration of the stemming by a pressure [m/s2]; one that rests stays at rest until the pressure is larger than its
/// resistance.
inline Real acceleration(const Collar& collar, const CollarState& state, Real pressure) {
  const Real push = pressure - collar.resistance * 4 * (collar.length - state.moved) / collar.diameter;
  return (state.velocity > 0 ? push : std::max<Real>(0, push)) / (collar.density * collar.length);
}

/// Takes a collar on to a time, at which the gas beneath it is this.
inline void step(const Collar& collar, CollarState& state, const CollarGas& gas, Real time) {
  const Real span = time - state.time, mean = 0.5 * (state.pressure + gas.pressure);
  state.time = time;
  state.pressure = gas.pressure;
  if (!state.is_open(collar)) {
    const Real former = state.velocity;
    state.velocity = std::max<Real>(0, former + span * acceleration(collar, state, mean));
    const Real forward = 0.5 * span * (former + state.velocity);
    state.moved += forward;
    state.lost_energy += std::min(mean * collar.area * forward, gas.energy);
    state.energy_rate = gas.pressure * collar.area * state.velocity;
    return;
  }
  const Real rate = gas.outflow(collar.area), power = rate * gas.enthalpy();
  if (state.mass_rate > 0) {
    state.lost_mass += 0.5 * span * (state.mass_rate + rate);
    state.lost_energy += 0.5 * span * (state.energy_rate + power);
  }
  state.velocity = 0;  // the stemming has left; what is behind it makes no more room
  state.mass_rate = rate;
  state.energy_rate = power;
}

}  // namespace sazare::methods::blocks
