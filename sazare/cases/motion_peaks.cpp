#include "sazare/cases/motion_peaks.hpp"

#include <algorithm>
#include <cmath>

#include "sazare/cases/motion_of_case.hpp"

namespace sazare::cases {

namespace {

constexpr Real most_samples = 1e6;
constexpr Real samples_of_a_period = 200;  // the peak of a sine is then found within 2e-4

}  // namespace

std::optional<MotionPeaks> peaks_of(const Motion& motion, Real end) {
  const bool is_record = motion.type == MotionShape::record;
  const Real step = is_record ? 0.5 * motion.record.step : 1 / (samples_of_a_period * motion.frequency);
  if (motion.type == MotionShape::function || (is_record && motion.record.value.size() < 2) || !(step > 0) || !(end > 0))
    return std::nullopt;
  const laws::GroundMotion history = motion_of_case(motion);
  const auto samples = static_cast<int>(std::min(std::ceil(end / step), most_samples));
  MotionPeaks peaks;
  for (int n = 0; n <= samples; ++n) {
    const auto now = history.at(std::min(n * step, end));
    peaks.acceleration = std::max(peaks.acceleration, std::abs(now.acceleration));
    peaks.velocity = std::max(peaks.velocity, std::abs(now.velocity));
    peaks.displacement = std::max(peaks.displacement, std::abs(now.displacement));
  }
  return peaks;
}

}  // namespace sazare::cases
