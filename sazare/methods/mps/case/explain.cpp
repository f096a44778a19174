#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sazare/cases/clocks.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/mps/case/fields.hpp"
#include "sazare/methods/mps/case/format.hpp"

namespace sazare::cases {
namespace {

std::string number(Real value) { return short_number(value, 4); }

template <class Enum>
std::string_view word(Enum value) {
  return EnumWords<Enum>::words.at(static_cast<std::size_t>(value));
}

std::string line(std::string_view topic, const std::string& text) { return fmt::format("  {:<12}{}\n", topic, text); }

std::string motion_text(const Motion& motion) {
  if (motion.type == MotionShape::function)
    return fmt::format("{}: {} as a function of time, given in Python, times {}", motion.name, word(motion.quantity),
                       number(motion.amplitude));
  if (motion.type != MotionShape::record)
    return fmt::format("{}: {} of {}, {} Hz, amplitude {}", motion.name, word(motion.type), word(motion.quantity),
                       number(motion.frequency), number(motion.amplitude));
  const laws::Record& record = motion.record;
  std::string text = fmt::format("{}: {}, {} of {} samples every {} s, times {}", motion.name, motion.file.filename().string(),
                                 word(motion.quantity), record.value.size(), number(record.step), number(motion.amplitude));
  if (motion.quantity == laws::MotionQuantity::acceleration && !record.value.empty())
    text += fmt::format("\n  {:<12}  baseline {}: velocity at its end {} m/s, displacement {} m", "", word(motion.baseline),
                        number(motion.amplitude * record.first.back()), number(motion.amplitude * record.second.back()));
  return text;
}

std::string boundary_text(const SideBoundary& boundary) {
  std::string text = fmt::format("{}: {}", word(boundary.side), word(boundary.kind));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (boundary.axes[axis]) text += fmt::format(" {}", "xyz"[axis]);
    if (!boundary.motion[axis].empty()) text += fmt::format(", {} moves as {}", "xyz"[axis], boundary.motion[axis]);
  }
  return text;
}

}  // namespace

std::string explain(const MpsCase& mps) {
  std::string text = mps.title + "\n";
  text += line("particles", fmt::format("spacing {} m in {}-D, influence radius {} spacings", number(mps.particles.spacing),
                                        mps.particles.dimension, number(mps.particles.influence)));
  for (const Ground& ground : mps.materials)
    text += line("materials",
                 fmt::format("{}: {} kg/m3, S-wave velocity {} m/s, P-wave velocity {} m/s, damping ratio {}, regions {}",
                             ground.name, number(ground.density), number(ground.s_wave_velocity), number(ground.p_wave_velocity),
                             number(ground.damping_ratio), fmt::join(ground.regions, ", ")));
  for (const Ground& ground : mps.materials)
    if (ground.yields)
      text += line("strength",
                   fmt::format("{}: cohesion {} Pa, friction angle {} deg, dilation angle {} deg, tension cut-off {} Pa, links "
                               "break at a plastic shear strain of {}",
                               ground.name, number(ground.cohesion), number(ground.friction_angle), number(ground.dilation_angle),
                               number(ground.tensile_strength), number(ground.rupture_strain)));
  if (mps.damping.f2 > 0) text += line("damping", fmt::format("at {} and {} Hz", number(mps.damping.f1), number(mps.damping.f2)));
  for (const Motion& motion : mps.motions) text += line("motions", motion_text(motion));
  for (const SideBoundary& boundary : mps.boundaries) text += line("boundaries", boundary_text(boundary));
  for (const Gauge& gauge : mps.gauges)
    text += line("gauges", fmt::format("{}: ({}, {}, {}) m", gauge.name, number(gauge.point.x()), number(gauge.point.y()),
                                       number(gauge.point.z())));
  const auto count = [&](Real interval) { return whole_multiple(mps.time.end, interval).value_or(0); };
  text +=
      line("time", fmt::format("to {} s by {}, {} history rows, {} snapshots", number(mps.time.end), word(mps.time.integrator),
                               count(mps.time.history_interval), count(mps.time.snapshot_interval)));
  return text;
}

}  // namespace sazare::cases
