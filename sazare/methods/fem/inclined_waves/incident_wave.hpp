#pragma once

/// A plane wave that comes into a body from below at an angle.

#include "sazare/core/time.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::methods::fem {

/// P: motion along the wave; SV: across it in the vertical plane; SH: horizontal and across that plane.
enum class WaveKind { p, sv, sh };

/// A wave that comes from below at an angle, in the frame of a body whose last axis points up.
struct IncidentWave {
  WaveKind kind = WaveKind::sv;
  Real angle = 0;    ///< from the vertical [rad]
  Real azimuth = 0;  ///< of its horizontal direction, from x towards y [rad]
  Index motion = 0;  ///< of the ground in the wave, along its direction of motion
  Real until = 0;    ///< the time to which its histories are asked for [s]
};

}  // namespace sazare::methods::fem
