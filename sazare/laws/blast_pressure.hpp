#pragma once

/// Gas pressure in a blast hole after its charge fires.
///
///     P = P_0 cos^2(pi/2 (t/a - 1))       0 <= t <= a            P_0  peak pressure [Pa]
///     P = P_0 cos(pi/(2 b) (t/a - 1))     a <= t <= (b + 1) a    a    rise time [s]
///     P = 0                               otherwise              b    decay time over rise time [-]
///
/// [Konno2018], eq. (4) and fig. 11.

#include <cmath>
#include <numbers>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct BlastPressure {
  Real peak = 0;         ///< P_0 [Pa]
  Real rise_time = 0;    ///< a [s]
  Real decay_ratio = 0;  ///< b [-]
};

inline Real blast_pressure(const BlastPressure& law, Real time) {
  const Real late = time / law.rise_time - 1;
  if (late < -1 || late > law.decay_ratio) return 0;
  constexpr Real quarter = std::numbers::pi / 2;
  if (late > 0) return law.peak * std::cos(quarter * late / law.decay_ratio);
  const Real rise = std::cos(quarter * late);
  return law.peak * rise * rise;
}

}  // namespace sazare::laws
