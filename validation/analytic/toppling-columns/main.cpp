#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sazare/methods/rectangles/case/case.hpp"
#include "sazare/methods/rectangles/run/model.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
constexpr Real slope = 30 * std::numbers::pi / 180, width = 1, weight_of_volume = 2500 * 9.81;

enum class Verdict { stable, slides, topples };

/// Goodman and Bray (1976), from the crest down: a column is pushed by P from above at the height of the lower of both tops,
/// and needs from below the larger of what keeps it from toppling and from sliding. Heights stand from the toe up. The prop at
/// the toe moves with the column, so it has no friction.
std::vector<Verdict> limit_equilibrium(const std::vector<Real>& height, Real friction) {
  const Real c = std::cos(slope), s = std::sin(slope);
  std::vector<Verdict> verdict(height.size(), Verdict::stable);
  Real push = 0;
  for (std::size_t n = height.size(); n-- > 0;) {
    const Real weight = weight_of_volume * width * height[n];
    const Real from_above = n + 1 < height.size() ? std::min(height[n], height[n + 1]) : height[n];
    const Real from_below = n > 0 ? std::min(height[n], height[n - 1]) : height[n];
    const Real topples = (push * (from_above - friction * width) + 0.5 * weight * (height[n] * s - width * c)) / from_below;
    const Real slides = n > 0 ? push - weight * (c * friction - s) / (1 - friction * friction)
                              : push * (1 - friction * friction) - weight * (c * friction - s);
    push = std::max({topples, slides, Real{0}});
    if (push > 0) verdict[n] = topples >= slides ? Verdict::topples : Verdict::slides;
  }
  return verdict;
}

Verdict verdict_of(const state::Particles<2>& particles, std::size_t column) {
  const Real turned = std::abs(particles.angle[column] - slope);
  const Real moved = std::hypot(particles.displacement[0][column], particles.displacement[1][column]);
  if (moved < 1e-3) return Verdict::stable;
  return turned > 5e-4 ? Verdict::topples : Verdict::slides;
}

}  // namespace

int main() {
  parallel::set_threads(1);
  const cases::CaseFile file = registry::read_case("cases/toppling-columns/case.toml");
  const auto& columns = file.as<cases::RectanglesCase>().blocks;
  std::vector<Real> height;
  for (const auto& column : columns) height.push_back(column.upper.y() - column.lower.y());
  const auto expected = limit_equilibrium(height, std::tan(file.as<cases::RectanglesCase>().contact.friction_angle * std::numbers::pi / 180));
  const runs::RectanglesModel model = runs::build_rectangles(file);
  model.stepper->start();
  while (model.stepper->time() < 3) model.stepper->advance();
  for (std::size_t n = 0; n < columns.size(); ++n)
    validation::print_row(fmt::format("column-{}", n + 1).c_str(), static_cast<Real>(verdict_of(model.stepper->particles(), n)),
                          static_cast<Real>(expected[n]));
}
