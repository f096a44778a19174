#pragma once

/// Flow of the gas of a charge from its hole into cracks, from crack to crack, and out of them at free faces.
///
/// Hole and cracks are vessels; two that share an edge of the mesh are joined by an opening: the edge's length times the smaller
/// width. Gas flows through it as through an orifice (compressible flow of a gas of exponent k without friction, C of it):
///
///     dm/dt = C S (2 k/(k - 1) p m/V (r^(2/k) - r^((k + 1)/k)))^1/2     r  pressure behind the opening over that before it, at
///                                                                       least (2/(k + 1))^(k/(k - 1)): then the flow is choked
///
/// and takes the enthalpy (E + p V)/m of the vessel before it along. In one step no more flows than makes the pressures equal, by
/// every opening of a vessel its part: so the flow is stable whatever the step, and mass and energy are kept.

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "sazare/core/time.hpp"
#include "sazare/laws/jwl.hpp"

namespace sazare::methods::blocks {

/// Gas in a hole or in a crack.
struct GasVessel {
  Real volume = 0;    ///< [m3]
  Real width = 0;     ///< of a crack; infinite for a hole [m]
  Real mass = 0;      ///< [kg]
  Real energy = 0;    ///< [J]
  Real pressure = 0;  ///< [Pa]
  Real sound = 0;     ///< velocity of sound [m/s]
  Index openings = 0;

  Real enthalpy() const { return mass > 0 ? (energy + pressure * volume) / mass : 0; }  ///< per mass [J/kg]
};

/// Where two vessels are joined; `second` is `outside` where the first one is open to the air.
struct Opening {
  static constexpr Index outside = -1;

  Index first = 0, second = outside;
  Real length = 0;                                      ///< of the edge [m]
  Real widest = std::numeric_limits<Real>::infinity();  ///< it is no wider than this [m]
};

/// What has left all vessels.
struct GasAmount {
  Real mass = 0;    ///< [kg]
  Real energy = 0;  ///< [J]
};

/// The gas that flows.
struct FlowingGas {
  laws::Jwl law;
  Real density = 0;    ///< of the explosive that it was [kg/m3]
  Real discharge = 1;  ///< C [-]

  Real exponent() const { return 1 + law.omega; }
  /// r below which the flow is choked, and what then stands in brackets above.
  Real critical_ratio = std::pow(2 / (exponent() + 1), exponent() / (exponent() - 1));
  Real choked_drive = drive(critical_ratio);
  Real drive(Real ratio) const {
    const Real root = std::pow(ratio, 1 / exponent());
    return root * root - ratio * root;
  }
  /// Finds the pressure of a vessel, and how fast sound is in it, from the rest of it.
  void settle(GasVessel& vessel) const;
};

/// Pressure of so much gas of that kind in a volume [Pa]; 0 where there is none.
inline Real gas_pressure(const FlowingGas& gas, Real volume, Real mass, Real energy) {
  const Real explosive = mass / gas.density;  // that the gas was [m3]
  if (!(explosive > 0) || !(volume > 0)) return 0;
  return std::max<Real>(0, laws::jwl_pressure(gas.law, volume / explosive, energy / explosive));
}

/// Mass through an opening of an area [m2], from a vessel to a place with that pressure [kg/s].
Real mass_rate(const FlowingGas& gas, const GasVessel& from, Real pressure, Real area);

/// Lets gas flow for a time [s], in equal steps short enough that no crack is filled in less than one, of which there are
/// `most_flow_steps` at most. Vessels are settled and know the number of their openings. Returns what has left.
GasAmount flow(const FlowingGas& gas, std::span<GasVessel> vessels, std::span<const Opening> openings, Real time);

inline constexpr int most_flow_steps = 16;

}  // namespace sazare::methods::blocks
