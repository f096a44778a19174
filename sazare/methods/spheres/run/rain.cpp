#include "sazare/methods/spheres/run/rain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/runs/progress.hpp"

namespace sazare::runs {

namespace {

/// Rain that becomes no calmer, by this factor, in so many of the times in which it is slowed to a third has no end.
constexpr Real calmer = 0.99, waits = 50;

/// Which spheres fall, and what slows them.
methods::spheres::RainRules rain_rules(const cases::SpheresCase& spheres, const SpheresModel& model) {
  constexpr std::int64_t most_steps = 20'000'000;
  methods::spheres::RainRules rules;
  rules.most_steps = most_steps;
  for (const Index group : model.group) rules.rains.push_back(spheres.spheres[static_cast<std::size_t>(group)].rain ? 1 : 0);
  // Falls with at most the speed sqrt(g H), H being how high the body is.
  const Real gravity = spheres.gravity.acceleration.norm();
  Real lowest = std::numeric_limits<Real>::infinity(), highest = -lowest;
  for (const auto& place : model.stepper->spheres().place) {
    const Real height = gravity > 0 ? -place.centre().dot(spheres.gravity.acceleration) / gravity : 0;
    lowest = std::min(lowest, height - place.radius);
    highest = std::max(highest, height + place.radius);
  }
  rules.damping = std::sqrt(gravity / (highest - lowest));
  return rules;
}

}  // namespace

bool let_rain(const cases::SpheresCase& spheres, SpheresModel& model, const RunOptions& options) {
  methods::spheres::RainRules rules = rain_rules(spheres, model);
  if (std::ranges::count(rules.rains, 1) == 0) return true;
  if (!options.quiet) fmt::print("falling to rest under gravity\n");
  std::fflush(stdout);
  Progress progress(options.quiet, {.smallest_step = model.steps.smallest(), .broken_joints = -1, .evaluated = "particle-steps"});
  const auto count = static_cast<std::int64_t>(model.group.size());
  const Real patience = waits / (rules.damping * model.steps.step);  // in steps
  Real first = 0, least = std::numeric_limits<Real>::infinity();
  std::int64_t calmer_at = 0;
  bool gains = true;
  rules.goes_on = [&](std::int64_t done, Real unrest) {
    first = std::max(first, unrest);
    if (unrest < calmer * least) {
      least = unrest;
      calmer_at = done;
    }
    gains = std::isfinite(unrest) && static_cast<Real>(done - calmer_at) < patience;
    if (!gains) return false;
    // What is left falls by about the same factor in equal times.
    if (progress.is_due())
      progress.show({std::log(first / unrest) / std::log(first), 0, done * count, model.steps.smallest(), -1, "particle-steps"});
    const bool goes_on = !options.stop.is_made();
    return options.sharing.ranks == nullptr ? goes_on : options.sharing.ranks->from_first(goes_on) != 0;
  };
  const methods::spheres::RainEnd end = model.stepper->rain(rules);
  if (gains && (!end.goes_on || end.unrest <= 1)) return end.goes_on;
  if (!std::isfinite(end.unrest))
    throw PhysicsError(
        fmt::format("the falling spheres (rain = true) have diverged after {} steps of {} s\n"
                    "  the step is too long for their contacts: give a smaller time.stability_fraction",
                    end.steps, cases::short_number(model.steps.step, 3)));
  throw PhysicsError(
      fmt::format("the falling spheres (rain = true) do not come to rest: after {} steps they move {} times as much as at rest\n"
                  "  there is no wall below them, or nothing dissipates their energy: check walls, friction and restitution",
                  end.steps, cases::short_number(end.unrest, 3)));
}

}  // namespace sazare::runs
