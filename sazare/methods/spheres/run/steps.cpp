#include "sazare/methods/spheres/run/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/levels/schedule/levels.hpp"
#include "sazare/methods/spheres/case/case.hpp"

namespace sazare::runs {

namespace {

using cases::SpheresCase;

/// Levels are taken unasked where they take less than this share of the steps that one step for all would.
constexpr Real worth_it = 0.5;

/// What each sphere bears between others [s].
std::vector<Real> contact_limits(const SpheresCase& spheres, const Placement& placement,
                                 const methods::spheres::ContactTable& contacts) {
  const state::Spheres& placed = placement.spheres;
  return laws::visit_law(contacts.model, [&]<class Law>(Law) {
    std::vector<Real> limits;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const auto number = static_cast<Index>(placed.spin[i].material);
      const cases::SphereMaterial& material = spheres.materials[static_cast<std::size_t>(number)];
      const state::SpherePlace& place = placed.place[i];
      const Real full = 4 * std::numbers::pi / 3 * material.density * std::pow(place.radius, 3);
      limits.push_back(Law::stable_step({{material.youngs_modulus, material.poisson_ratio},
                                         material.density,
                                         place.radius,
                                         place.mass,
                                         placement.bonded_body[i] >= 0 ? place.mass / full : 1,
                                         contacts.row(number)}));
    }
    return limits;
  });
}

/// Mass that a clump shows to an impulse where it turns most easily [kg].
Real least_mass(const state::Clumps& clumps, std::size_t clump, const state::Spheres& placed) {
  const state::Clump& of = clumps.clumps[clump];
  Real arm = 0;
  for (const auto& member : clumps.members_of(clump)) {
    const Real radius = placed.place[static_cast<std::size_t>(member.sphere)].radius;
    arm = std::max(arm, member.place.norm() + radius);
  }
  return 1 / (1 / of.mass + arm * arm / of.inertia.minCoeff());
}

/// The step of all, which divides a clock [s].
Real choose_step(const cases::CaseFile& file, Real limit, Real clock) {
  const cases::SphereTime& time = file.as<cases::SpheresCase>().time;
  if (!time.step) return clock / std::ceil(clock / (time.stability_fraction * limit));
  if (*time.step > limit)
    refuse(file, "time.step",
           fmt::format("the step of {} s is {} times the limit of {} s", cases::short_number(*time.step, 4),
                       cases::short_number(*time.step / limit, 4), cases::short_number(limit, 4)),
           fmt::format("choose {} s or less, or give no step", cases::short_number(0.2 * limit, 3)));
  return *time.step;
}

/// Steps of single spheres per second, about: each at the coarsest level under its own step, of which `steps` rise, and the finer
/// ones with what touches them.
Real rate(const std::vector<Real>& steps, Real base_step) {
  constexpr std::ptrdiff_t kicked_together = 3;
  const auto all = static_cast<std::ptrdiff_t>(steps.size());
  Real sum = static_cast<Real>(all) / base_step;
  for (Real step = base_step;; step /= 2) {
    const std::ptrdiff_t finer = std::ranges::lower_bound(steps, step) - steps.begin();
    if (finer == 0) return sum;
    sum += static_cast<Real>(std::min(all, kicked_together * finer)) / step;  // they step twice as often
  }
}

/// The base step for which spheres need the fewest steps [s]; it divides a clock.
Real choose_base_step(const std::vector<Real>& steps, Real clock) {
  constexpr int octaves = 4, candidates_per_octave = 16;
  Real best = 0, fewest = std::numeric_limits<Real>::infinity();
  for (int i = 0; i <= octaves * candidates_per_octave; ++i) {
    const Real wished = steps.back() * std::exp2(-static_cast<Real>(i) / candidates_per_octave);
    const Real step = clock / std::ceil(clock / wished), now = rate(steps, step);
    if (now >= fewest) continue;
    fewest = now;
    best = step;
  }
  return best;
}

/// What each sphere bears between others, on its bonds, and with the others of its clump [s].
std::vector<Real> step_limits(const SpheresCase& spheres, const Placement& placement, const SphereStepLimits& all) {
  std::vector<Real> limits = contact_limits(spheres, placement, all.contacts);
  const std::vector<Real> by_bonds = methods::spheres::stable_steps(all.bonds.bonds(), placement.spheres);
  for (std::size_t i = 0; i < limits.size(); ++i) limits[i] = std::min(limits[i], by_bonds[i]);
  for (std::size_t c = 0; c < placement.clumps.clumps.size(); ++c) {
    Real least = std::numeric_limits<Real>::infinity();
    const auto limit_of = [&](const state::ClumpMember& member) -> Real& {
      return limits[static_cast<std::size_t>(member.sphere)];
    };
    for (const auto& member : placement.clumps.members_of(c)) least = std::min(least, limit_of(member));
    // As if all stood where it turns most easily: a sphere that stands alone turns on 2/7 of its mass.
    const Real shown = least_mass(placement.clumps, c, placement.spheres) / placement.clumps.clumps[c].mass;
    least *= std::sqrt(std::min(shown * 7 / 2, Real{1}));
    for (const auto& member : placement.clumps.members_of(c)) limit_of(member) = least;
  }
  return limits;
}

/// Levels for spheres of which each bears so much, beside one step for all.
SphereSteps choose_levels(const std::vector<Real>& limits, Real fraction, Real clock, const SphereSteps& uniform) {
  std::vector<Real> rising;
  rising.reserve(limits.size());
  for (const Real limit : limits) rising.push_back(fraction * limit);
  std::ranges::sort(rising);
  SphereSteps steps;
  steps.limit = uniform.limit;
  steps.step = choose_base_step(rising, clock);
  steps.particle_steps = rate(rising, steps.step) * steps.step;
  steps.share_of_uniform = steps.particle_steps / steps.step * uniform.step / uniform.particle_steps;
  steps.count.assign(static_cast<std::size_t>(schedule::level_for(rising.front(), steps.step)) + 1, 0);
  for (const Real limit : limits) {
    steps.level.push_back(static_cast<std::int8_t>(schedule::level_for(fraction * limit, steps.step)));
    ++steps.count[static_cast<std::size_t>(steps.level.back())];
  }
  return steps;
}

}  // namespace

Real SphereSteps::smallest() const { return std::ldexp(step, count.empty() ? 0 : 1 - static_cast<int>(count.size())); }

SphereSteps choose_steps(const cases::CaseFile& file, const Placement& placement, const SphereStepLimits& limits,
                         std::optional<Real> window) {
  const SpheresCase& spheres = file.as<cases::SpheresCase>();
  const cases::SphereTime& time = spheres.time;
  if (window && time.levels == cases::SphereLevels::per_sphere)
    refuse(file, "time.levels", "spheres that are coupled take one step for all", "give levels = \"uniform\", or leave it out");
  const std::vector<Real> own = step_limits(spheres, placement, limits);
  SphereSteps steps;
  steps.limit = std::ranges::min(own);
  const Real clock = window.value_or(time.history_interval);
  steps.step = choose_step(file, steps.limit, clock);
  steps.particle_steps = static_cast<Real>(own.size());
  if (window || time.levels == cases::SphereLevels::uniform || time.step) return steps;
  const SphereSteps leveled = choose_levels(own, time.stability_fraction, clock, steps);
  const bool takes_them = time.levels == cases::SphereLevels::per_sphere || leveled.share_of_uniform <= worth_it;
  return takes_them && leveled.count.size() > 1 ? leveled : steps;
}

}  // namespace sazare::runs
