#pragma once

#include <optional>

#include "sazare/cases/tables.hpp"

namespace sazare::cases {

/// The largest magnitudes of a motion in a run.
struct MotionPeaks {
  Real acceleration = 0;  ///< [m/s2]
  Real velocity = 0;      ///< [m/s]
  Real displacement = 0;  ///< [m]
};

/// Until the end of the run [s]; nothing for a function, and for a record that was not read.
std::optional<MotionPeaks> peaks_of(const Motion& motion, Real end);

}  // namespace sazare::cases
