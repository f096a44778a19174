#pragma once

/// Rayleigh damping from a damping ratio and two frequencies.
///
///     C = a1 h M + a2 h K     a1 = 4 pi f1 f2/(f1 + f2) [1/s]     f1, f2  frequencies at which the ratio is h [Hz]
///                             a2 = 1/(pi (f1 + f2)) [s]           h       damping ratio of the material [-]
///
/// Between f1 and f2 the damping ratio of a mode is below h, outside above it. [Yoshida2010], eq. (A16) and (A18).

#include <numbers>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct RayleighDamping {
  Real mass_rate = 0;       ///< a1 [1/s]
  Real stiffness_time = 0;  ///< a2 [s]

  static RayleighDamping make(Real f1, Real f2) {
    return {4 * std::numbers::pi * f1 * f2 / (f1 + f2), 1 / (std::numbers::pi * (f1 + f2))};
  }

  /// Damping ratio of a mode of this frequency [Hz] where the material's is `ratio`.
  Real ratio_at(Real frequency, Real ratio) const {
    const Real omega = 2 * std::numbers::pi * frequency;
    return 0.5 * ratio * (mass_rate / omega + stiffness_time * omega);
  }
};

}  // namespace sazare::laws
