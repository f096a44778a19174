#include "sazare/cases/explanation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "sazare/cases/fields.hpp"
#include "sazare/cases/format/units.hpp"
#include "sazare/cases/motion_peaks.hpp"

namespace sazare::cases {
namespace {

std::string shape_text(const Motion& motion) {
  switch (motion.type) {
    case MotionShape::function:
      return fmt::format("{} as a function of time, given in Python, times {}", word(motion.quantity), number(motion.amplitude));
    case MotionShape::record:
      return fmt::format("{}, {} of {} samples every {} s, times {}", motion.file.filename().string(), word(motion.quantity),
                         motion.record.value.size(), number(motion.record.step), number(motion.amplitude));
    default:
      return fmt::format("{} of {}, {} Hz, amplitude {}", word(motion.type), word(motion.quantity), number(motion.frequency),
                         number(motion.amplitude));
  }
}

/// What has no peak, such as the acceleration of displacements joined by straight lines, is left out.
std::string peaks_text(const MotionPeaks& peaks) {
  std::string text;
  const auto add = [&](Real peak, const char* unit, const char* small_unit) {
    if (peak > 0)
      text += fmt::format("{}{} {} ({} {})", text.empty() ? "peaks " : ", ", number(peak), unit, number(100 * peak), small_unit);
  };
  add(peaks.acceleration, "m/s2", "gal");
  add(peaks.velocity, "m/s", "cm/s");
  add(peaks.displacement, "m", "cm");
  return text.empty() ? "does not move" : text;
}

constexpr int elements_per_wave = 10;

/// [Hz]; nothing for what has none, such as a function of Python.
std::optional<Real> frequency_of(const Motion& motion, Real end) {
  if (motion.type == MotionShape::function) return std::nullopt;
  if (motion.type != MotionShape::record) return motion.frequency;
  const auto peaks = peaks_of(motion, end);
  if (!peaks || !(peaks->acceleration > 0) || !(peaks->velocity > 0)) return std::nullopt;
  return peaks->acceleration / (2 * std::numbers::pi * peaks->velocity);
}

std::string end_text(const Motion& motion) {
  return fmt::format("baseline {}: velocity at the end of the record {} m/s, displacement {} m", word(motion.baseline),
                     number(motion.amplitude * motion.record.first.back()),
                     number(motion.amplitude * motion.record.second.back()));
}

}  // namespace

std::string vector_text(const Vector3& value) {
  return fmt::format("({}, {}, {})", number(value.x()), number(value.y()), number(value.z()));
}

std::string line(std::string_view topic, std::string_view text) { return fmt::format("  {:<12}{}\n", topic, text); }

std::string motion_names_text(std::span<const std::string> motion, bool is_incident_wave) {
  std::string text;
  for (std::size_t axis = 0; axis < motion.size(); ++axis) {
    if (motion[axis].empty()) continue;
    text += is_incident_wave ? fmt::format(", {} enters along {}", motion[axis], "xyz"[axis])
                             : fmt::format(", {} moves as {}", "xyz"[axis], motion[axis]);
  }
  return text;
}

std::string cut_off_text(const std::optional<Real>& tensile_strength) {
  return tensile_strength ? number(*tensile_strength) + " Pa" : "none (the tip of the shear strength limits tension)";
}

std::string explain_motions(const std::vector<Motion>& motions, Real end) {
  std::string text;
  for (const Motion& motion : motions) {
    text += line("motions", fmt::format("{}: {}", motion.name, shape_text(motion)));
    if (const auto peaks = peaks_of(motion, end)) text += line("", "  " + peaks_text(*peaks));
    if (motion.type == MotionShape::record && motion.quantity == laws::MotionQuantity::acceleration)
      text += line("", "  " + end_text(motion));
  }
  return text;
}

std::string explain_gravity(const Vector3& acceleration, std::string_view more) {
  return acceleration.isZero() ? "" : line("gravity", fmt::format("{} m/s2{}", vector_text(acceleration), more));
}

std::string explain_waves(const std::string& material, Real p_wave, Real s_wave, Real size) {
  return line("waves", fmt::format("{}: P {} m/s, S {} m/s; S waves of {} Hz are ten times {} m long", material, number(p_wave),
                                   number(s_wave), number(s_wave / (elements_per_wave * size)), number(size)));
}

std::string mass_text(Real mass, bool in_plane) {
  const Real weight = standard_gravity * mass;
  const bool is_large = weight >= 1e6, is_small = weight < 1e3;
  const std::string_view per_length = in_plane ? "/m" : "";
  return fmt::format("{} kg{}, weight {} {}{}", number(mass), per_length,
                     number(weight / (is_large   ? 1e6
                                      : is_small ? 1
                                                 : 1e3)),
                     is_large   ? "MN"
                     : is_small ? "N"
                                : "kN",
                     per_length);
}

std::string warn_of_short_waves(const CaseSource& source, const std::vector<Motion>& motions, Real end, Real s_wave, Real size) {
  const Real followed = s_wave / (elements_per_wave * size);
  std::string all;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto frequency = frequency_of(motions[i], end);
    if (!frequency || *frequency <= followed) continue;
    all += warning(
        source, fmt::format("motions.{}.name", i),
        fmt::format("the motion \"{}\" of {} Hz or so is faster than what a size of {} m follows: S waves of {} m/s are "
                    "{} of them long at {} Hz",
                    motions[i].name, number(*frequency, 2), number(size), number(s_wave), elements_per_wave, number(followed, 2)),
        "make them smaller; or check the unit of lengths, of velocities and of the time of the record");
  }
  return all;
}

std::string limit_text(Real limit, int digits) {
  return std::isfinite(limit) ? fmt::format("limit {} s", number(limit, digits)) : "no limit, for no springs act at the start";
}

std::string stress_text(Real stress) {
  if (std::abs(stress) < 1e3 || !std::isfinite(stress)) return number(stress) + " Pa";
  const bool is_large = std::abs(stress) >= 1e5;
  return fmt::format("{} Pa ({} {})", number(stress), number(stress / (is_large ? 1e6 : 1e3)), is_large ? "MPa" : "kPa");
}

}  // namespace sazare::cases
