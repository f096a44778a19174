#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sazare/cases/clocks.hpp"
#include "sazare/cases/explanation.hpp"
#include "sazare/methods/mps/case/fields.hpp"
#include "sazare/methods/mps/case/format.hpp"

namespace sazare::cases {
namespace {

std::string boundary_text(const SideBoundary& boundary) {
  std::string text = fmt::format("{}: {}", word(boundary.side), word(boundary.kind));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (boundary.axes[axis]) text += fmt::format(" {}", "xyz"[axis]);
  return text + motion_names_text(boundary.motion, boundary.kind == SideKind::viscous);
}

/// What the strength of a ground falls to.
std::string softening_text(const Ground& ground) {
  std::vector<std::string> falls;
  if (ground.residual_cohesion) falls.push_back(fmt::format("cohesion falls to {} Pa", number(*ground.residual_cohesion)));
  if (ground.residual_friction_angle) {
    falls.push_back(fmt::format("friction angle falls to {} deg", number(*ground.residual_friction_angle)));
    if (ground.dilation_angle > 0) falls.push_back("dilation ends");
  }
  return fmt::format("{}: {}, at first over a slip of {} m across a band", ground.name, fmt::join(falls, ", "),
                     number(ground.softening_displacement));
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
    if (ground.degrades) text += line("soil", ground.name + ":" + soil_text(ground, ground.shear_modulus()));
  for (const Ground& ground : mps.materials)
    if (ground.yields)
      text += line("strength",
                   fmt::format("{}: cohesion {} Pa, friction angle {} deg, dilation angle {} deg, tension cut-off {}, links "
                               "break at a plastic shear strain of {}",
                               ground.name, number(ground.cohesion), number(ground.friction_angle), number(ground.dilation_angle),
                               cut_off_text(ground.tensile_strength), number(ground.rupture_strain)));
  for (const Ground& ground : mps.materials)
    if (ground.softens()) text += line("strength", softening_text(ground));
  if (mps.damping.f2 > 0) text += line("damping", fmt::format("at {} and {} Hz", number(mps.damping.f1), number(mps.damping.f2)));
  text += explain_gravity(mps.gravity.acceleration);
  text += explain_motions(mps.motions, mps.time.end);
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
