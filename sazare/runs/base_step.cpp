#include "sazare/runs/base_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sazare/schedule/levels.hpp"

namespace sazare::runs {

namespace {

/// Joint evaluations per second of simulated time.
Real evaluation_rate(std::span<const Real> steps, const methods::blocks::Joints& joints, Real base_step) {
  std::vector<int> level;
  for (const Real step : steps) level.push_back(schedule::level_for(step, base_step));
  Real evaluations = 0;
  for (const Link& link : joints.links())
    evaluations += std::ldexp(1.0, std::max(level[static_cast<std::size_t>(link.first)], level[static_cast<std::size_t>(link.second)]));
  return evaluations / base_step;
}

}  // namespace

Real choose_base_step(std::span<const Real> stable_steps, const methods::blocks::Joints& joints, Real fraction,
                      Real history_interval) {
  std::vector<Real> steps;
  Real longest = 0, shortest = std::numeric_limits<Real>::infinity();
  for (const Real step : stable_steps) {
    steps.push_back(fraction * step);
    if (std::isfinite(step)) longest = std::max(longest, fraction * step);
    shortest = std::min(shortest, fraction * step);
  }
  if (longest == 0 || !std::isfinite(shortest)) return history_interval;
  constexpr int octaves = 4, candidates_per_octave = 16;
  Real best = 0, fewest = std::numeric_limits<Real>::infinity();
  for (int i = 0; i <= octaves * candidates_per_octave; ++i) {
    const Real wished = longest * std::exp2(-static_cast<Real>(i) / candidates_per_octave);
    const Real step = history_interval / std::ceil(history_interval / wished);
    const Real rate = evaluation_rate(steps, joints, step);
    if (rate < fewest) {
      fewest = rate;
      best = step;
    }
  }
  return best;
}

}  // namespace sazare::runs
