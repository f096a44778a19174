#pragma once

/// Gas of an explosive after its detonation, by the equation of state of Jones, Wilkins and Lee [Lee1968]:
///
///     p = A (1 - w/(R1 v)) exp(-R1 v) + B (1 - w/(R2 v)) exp(-R2 v) + w e/v
///
///     v            volume over that of the explosive [-]
///     e            energy of the gas per volume of the explosive [J/m3]
///     A, B [Pa], R1, R2, w [-]   constants of the explosive
///
/// It expands along p = A exp(-R1 v) + B exp(-R2 v) + C v^-(1+w), where C follows from the energy that it has at some volume:
///
///     e = A/R1 exp(-R1 v) + B/R2 exp(-R2 v) + C/(w v^w)
///
/// A = B = 0 is a gas of a constant exponent g = 1 + w.
///
/// [Lee1968] E. L. Lee, H. C. Hornig, J. W. Kury: Adiabatic expansion of high explosive detonation products. Lawrence Radiation
/// Laboratory, UCRL-50422, 1968.

#include <cmath>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct Jwl {
  Real a = 0, b = 0;    ///< A, B [Pa]
  Real r1 = 1, r2 = 1;  ///< R1, R2 [-]
  Real omega = 0;       ///< w [-]
};

/// Pressure [Pa] at a relative volume and an energy per volume of the explosive [J/m3].
inline Real jwl_pressure(const Jwl& law, Real volume, Real energy) {
  return law.a * (1 - law.omega / (law.r1 * volume)) * std::exp(-law.r1 * volume) +
         law.b * (1 - law.omega / (law.r2 * volume)) * std::exp(-law.r2 * volume) + law.omega * energy / volume;
}

/// Energy per volume of the explosive [J/m3] of the gas when it has expanded without loss of heat from one relative volume to
/// another.
inline Real jwl_expanded_energy(const Jwl& law, Real from, Real energy, Real to) {
  const auto cold = [&](Real volume) {
    return law.a / law.r1 * std::exp(-law.r1 * volume) + law.b / law.r2 * std::exp(-law.r2 * volume);
  };
  return cold(to) + (energy - cold(from)) * std::pow(from / to, law.omega);
}

/// -v dp/dv over p along the expansion, with which p changes by that part of a relative change of the volume [-].
inline Real jwl_exponent(const Jwl& law, Real volume, Real energy) {
  const Real first = law.a * std::exp(-law.r1 * volume), second = law.b * std::exp(-law.r2 * volume);
  const Real gas = law.omega * (energy - first / law.r1 - second / law.r2) / volume;
  return (volume * (law.r1 * first + law.r2 * second) + (1 + law.omega) * gas) / (first + second + gas);
}

}  // namespace sazare::laws
