#pragma once

/// Explosives whose constants are published: density, velocity of the detonation, energy, and the gas that they turn into.
///
/// Constants are those commonly quoted from [Lee1968] (laws/jwl.hpp) for ANFO, a mixture of ammonium nitrate and fuel oil, and
/// from [Dobratz1985] for the others. A test holds each row to the laws of detonation: the gas behind the front, whose pressure
/// follows from density, velocity and energy, lies on the expansion of its equation of state, which there is as steep as the line
/// of Rayleigh (Chapman and Jouguet). Rows that fail by more than 2 % are not in the table.
///
/// Commercial explosives do not burn completely in thin holes: their velocity depends on diameter and confinement, so give the
/// measured one.
///
/// [Dobratz1985] B. M. Dobratz, P. C. Crawford: LLNL explosives handbook. Lawrence Livermore National Laboratory,
/// UCRL-52997, change 2, 1985.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "sazare/laws/jwl.hpp"

namespace sazare::laws {

struct Explosive {
  std::string_view name;
  Real density = 0;   ///< [kg/m3]
  Real velocity = 0;  ///< of the detonation [m/s]
  Real energy = 0;    ///< per volume [J/m3]
  Jwl gas;
};

inline constexpr std::array explosives{
    Explosive{"ANFO", 931, 4160, 2.484e9, {49.46e9, 1.891e9, 3.907, 1.118, 1.0 / 3}},
    Explosive{"C-4", 1601, 8193, 9.0e9, {609.77e9, 12.95e9, 4.5, 1.4, 0.25}},
    Explosive{"composition B", 1717, 7980, 8.5e9, {524.2e9, 7.678e9, 4.2, 1.1, 0.34}},
    Explosive{"pentolite", 1700, 7530, 8.1e9, {540.94e9, 9.3726e9, 4.5, 1.1, 0.35}},
    Explosive{"PETN 1.26", 1260, 6540, 7.19e9, {573.1e9, 20.16e9, 6.0, 1.8, 0.28}},
    Explosive{"PETN 1.50", 1500, 7450, 8.56e9, {625.3e9, 23.29e9, 5.25, 1.6, 0.28}},
    Explosive{"PETN 1.77", 1770, 8300, 10.1e9, {617.0e9, 16.926e9, 4.4, 1.2, 0.25}},
    Explosive{"TNT", 1630, 6930, 7.0e9, {371.2e9, 3.231e9, 4.15, 0.95, 0.30}},
};

inline constexpr const Explosive& anfo = explosives[0];

/// How far an explosive is from the laws of a steady detonation, 0 for one that fulfils them. The gas behind the front has the
/// volume V, the pressure P = density D^2 (1 - V) and the energy E + P (1 - V)/2, and its expansion touches the line of Rayleigh
/// there (Chapman and Jouguet): of the relative errors of P and of the slope the larger, at the V where it is least.
inline Real detonation_mismatch(const Explosive& explosive) {
  const Real stiffness = explosive.density * explosive.velocity * explosive.velocity;
  Real least = std::numeric_limits<Real>::infinity();
  for (int i = 400; i < 950; ++i) {
    const Real volume = 1e-3 * i, front = stiffness * (1 - volume), energy = explosive.energy + front * (1 - volume) / 2;
    const Real pressure = jwl_pressure(explosive.gas, volume, energy);
    const Real slope = jwl_exponent(explosive.gas, volume, energy) * pressure / volume;
    least = std::min(least, std::max(std::abs(pressure / front - 1), std::abs(slope / stiffness - 1)));
  }
  return least;
}

/// The energy per mass [J/kg] of an explosive whose gas has a constant exponent and which detonates steadily with a velocity.
inline Real energy_by_velocity(Real velocity, Real exponent) { return velocity * velocity / (2 * (exponent * exponent - 1)); }

}  // namespace sazare::laws
