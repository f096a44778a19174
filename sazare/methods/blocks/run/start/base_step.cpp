#include "sazare/methods/blocks/run/start/base_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sazare/levels/schedule/levels.hpp"

namespace sazare::runs {

namespace {

std::vector<int> levels_of(std::span<const Real> steps, Real base_step) {
  std::vector<int> levels;
  for (const Real step : steps) levels.push_back(schedule::level_for(step, base_step));
  return levels;
}

int face_level(const std::vector<int>& levels, const methods::blocks::JointFace& face) {
  return std::max(levels[static_cast<std::size_t>(face.master)], levels[static_cast<std::size_t>(face.slave)]);
}

/// Joint evaluations per second of simulated time.
Real evaluation_rate(std::span<const Real> steps, std::span<const methods::blocks::JointFace> faces, Real base_step) {
  const std::vector<int> levels = levels_of(steps, base_step);
  Real evaluations = 0;
  for (const auto& face : faces) evaluations += std::ldexp(1.0, face_level(levels, face));
  return evaluations / base_step;
}

}  // namespace

Real choose_base_step(std::span<const Real> steps, std::span<const methods::blocks::JointFace> faces, Real history_interval) {
  Real longest = 0;
  for (const Real step : steps)
    if (std::isfinite(step)) longest = std::max(longest, step);
  if (longest == 0) return history_interval;
  constexpr int octaves = 4, candidates_per_octave = 16;
  Real best = 0, fewest = std::numeric_limits<Real>::infinity();
  for (int i = 0; i <= octaves * candidates_per_octave; ++i) {
    const Real wished = longest * std::exp2(-static_cast<Real>(i) / candidates_per_octave);
    const Real step = history_interval / std::ceil(history_interval / wished);
    const Real rate = evaluation_rate(steps, faces, step);
    if (rate < fewest) {
      fewest = rate;
      best = step;
    }
  }
  return best;
}

void sort_by_level(std::vector<methods::blocks::JointFace>& faces, std::span<const Real> steps, Real base_step) {
  const std::vector<int> levels = levels_of(steps, base_step);
  std::ranges::stable_sort(faces, {}, [&](const auto& face) { return face_level(levels, face); });
}

}  // namespace sazare::runs
