#pragma once

/// A bar or spring whose axial force has limits: perfectly plastic in tension, and in compression as the limits say.
///
///     N = N_0 + k (e - p)                        N    axial force, tension positive [N]
///     N <= F_y, where it flows: p grows          N_0  force before it is moved [N]
///     N >= -F_y, where it flows: p falls         k    stiffness [N/m]
///                                                e    elongation [m]
///                                                p    plastic elongation, the memory [m]
///                                                F_y  yield force [N]
///
/// With a compression limit F_c <= F_y it gives way at -F_c instead, and forgets it: longer again, it bears as before. That is a
/// slender bar past buckling, whose force hardly changes (Euler's elastica), and with F_c = 0 a rod or cable that goes slack.

#include <limits>
#include <optional>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct AxialLimits {
  Real stiffness = 0;                                  ///< k [N/m]
  Real prestress = 0;                                  ///< N_0 [N]
  Real yield = std::numeric_limits<Real>::infinity();  ///< F_y [N]
  std::optional<Real> compression{};                   ///< F_c [N]
};

struct AxialResponse {
  Real force = 0;    ///< N [N]
  Real plastic = 0;  ///< p [m]
  Real tangent = 0;  ///< of the force by the elongation [N/m]
  Real energy = 0;   ///< stored since the beginning; its derivative by e is N [J]
};

/// `elongation` e, plastic elongation p so far.
inline AxialResponse respond(const AxialLimits& law, Real elongation, Real plastic) {
  AxialResponse response{0, plastic, law.stiffness, 0};
  const auto stored = [&](Real force) { return (force * force - law.prestress * law.prestress) / (2 * law.stiffness); };
  const Real trial = law.prestress + law.stiffness * (elongation - plastic);
  response.force = trial;
  if (law.compression && trial < -*law.compression) {
    response.force = -*law.compression;
    response.tangent = 0;
    const Real beyond = (trial - response.force) / law.stiffness;
    response.energy = stored(response.force) + response.force * beyond;
    return response;
  }
  if (const Real over = std::abs(trial) - law.yield; over > 0) {
    response.force = std::copysign(law.yield, trial);
    response.plastic += std::copysign(over / law.stiffness, trial);
    response.tangent = 0;
  }
  response.energy = stored(response.force);
  return response;
}

}  // namespace sazare::laws
