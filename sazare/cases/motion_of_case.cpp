#include "sazare/cases/motion_of_case.hpp"

namespace sazare::cases {

laws::GroundMotion motion_of_case(const Motion& motion) {
  laws::GroundMotion result;
  result.shape = static_cast<laws::GroundMotion::Shape>(motion.type);
  result.quantity = motion.quantity;
  result.amplitude = motion.amplitude;
  result.ricker_wave = {motion.frequency, motion.peak_time};
  result.sine_wave = {motion.frequency, motion.cycles};
  result.record = motion.record;
  result.samples = motion.samples;
  return result;
}
static_assert(static_cast<int>(laws::GroundMotion::Shape::function) == static_cast<int>(MotionShape::function));

laws::GroundMotion constant_velocity(Real velocity, Real end) {
  laws::GroundMotion result;
  result.shape = laws::GroundMotion::Shape::record;
  result.quantity = laws::MotionQuantity::velocity;
  result.record = laws::Record::make(2 * end, {velocity, velocity});
  return result;
}

}  // namespace sazare::cases
