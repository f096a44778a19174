#pragma once

#include "sazare/cases/mps_case.hpp"

namespace sazare::runs {

/// A motion of a case as the law that gives it at any time.
inline laws::GroundMotion make_motion(const cases::Motion& motion) {
  laws::GroundMotion result;
  result.shape = static_cast<laws::GroundMotion::Shape>(motion.type);
  result.quantity = motion.quantity;
  result.amplitude = motion.amplitude;
  result.ricker_wave = {motion.frequency, motion.peak_time};
  result.sine_wave = {motion.frequency, motion.cycles};
  result.record = motion.record;
  return result;
}
static_assert(static_cast<int>(laws::GroundMotion::Shape::record) == static_cast<int>(cases::MotionShape::record));

}  // namespace sazare::runs
