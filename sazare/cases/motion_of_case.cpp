#include "sazare/cases/motion_of_case.hpp"

#include <algorithm>

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

std::optional<laws::GroundMotion> motion_named(std::span<const Motion> motions, const std::string& name) {
  const auto found = std::ranges::find(motions, name, &Motion::name);
  if (name.empty() || found == motions.end()) return std::nullopt;
  return motion_of_case(*found);
}

laws::GroundMotion constant_velocity(Real velocity, Real end) {
  laws::GroundMotion result;
  result.shape = laws::GroundMotion::Shape::record;
  result.quantity = laws::MotionQuantity::velocity;
  result.record = laws::Record::make(2 * end, {velocity, velocity});
  return result;
}

}  // namespace sazare::cases
