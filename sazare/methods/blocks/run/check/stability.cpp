#include "sazare/methods/blocks/run/check/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sazare/cases/clocks.hpp"
#include "sazare/cases/extent.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/saturated.hpp"
#include "sazare/geometry/tetrahedron.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::runs {

namespace {

std::string seconds(Real value) { return cases::short_number(value, 3) + " s"; }

/// The largest base step that is stable for all elements and divides the history interval.
Real stable_base_step(const cases::Time& time, Real smallest) {
  const Real parts = std::ceil(time.history_interval / (stable_share * smallest));
  return cases::whole_fraction(time.history_interval, saturated<std::int64_t>(parts));
}

}  // namespace

std::string element_text(const geometry::TetraMesh& mesh, Index element) {
  const Vector3 centre = geometry::centroid(geometry::corners_of(mesh, element));
  return fmt::format("element {} at ({}, {}, {}) m", element_tag(mesh, element), cases::short_number(centre.x(), 4),
                     cases::short_number(centre.y(), 4), cases::short_number(centre.z(), 4));
}

std::vector<LimitingElement> limiting_elements(const BlocksModel& model, std::size_t count) {
  std::vector<Index> order(model.stable_step.size());
  std::iota(order.begin(), order.end(), 0);
  count = std::min(count, order.size());
  const auto step = [&](Index element) { return model.stable_step[at(element)]; };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](Index a, Index b) { return step(a) != step(b) ? step(a) < step(b) : a < b; });
  std::vector<LimitingElement> limiting;
  for (std::size_t i = 0; i < count; ++i) limiting.push_back({order[i], step(order[i])});
  return limiting;
}

std::vector<Index> level_histogram(const BlocksModel& model) {
  const auto& levels = model.simulation->levels();
  std::vector<Index> counts;
  for (Index element = 0; element < model.simulation->bodies().size(); ++element) {
    counts.resize(std::max(counts.size(), at(levels.level(element)) + 1));
    ++counts[at(levels.level(element))];
  }
  return counts;
}

Real evaluations_per_second(const BlocksModel& model) {
  const auto& levels = model.simulation->levels();
  Real evaluations = 0;
  for (const Link& link : model.joints->links())
    evaluations += 1 / levels.step(std::max(levels.level(link.first), levels.level(link.second)));
  return evaluations;
}

std::string check_stability(const cases::CaseFile& file, const BlocksModel& model) {
  const cases::Time& time = file.as<cases::BlocksCase>().time;
  const LimitingElement shortest = limiting_elements(model, 1).front();
  if (!(shortest.stable_step > 0))
    refuse(file, "time",
           fmt::format("no step is stable: the stability limit of {} is 0 s", element_text(model.mesh, shortest.element)),
           "its springs or dashpots are beyond any measure: check stiffness, damping and density of its material and joints");
  const bool by_fraction = time.limiter == cases::Limiter::stability;
  const Real base_step = model.simulation->levels().step(0);
  if (by_fraction && time.stability_fraction <= stable_share) return {};
  const auto above = std::ranges::count_if(model.stable_step, [&](Real step) {
    return (by_fraction ? time.stability_fraction * step : base_step) > stable_share * step;
  });
  if (above == 0) return {};
  const std::string who =
      fmt::format("{} of {} elements; the smallest stability limit, {}, is that of {}", above, model.stable_step.size(),
                  seconds(stable_share * shortest.stable_step), element_text(model.mesh, shortest.element));
  const std::string key = by_fraction ? "time.stability_fraction" : "time.base_step";
  const std::string what = by_fraction ? fmt::format("step above the stability limit: stability_fraction = {} is above {}, {}",
                                                     cases::short_number(time.stability_fraction), stable_share,
                                                     "up to which steps are stable when the neighbours move as well")
                                       : fmt::format("step above the stability limit: base_step = {} s is too long for {}",
                                                     cases::short_number(base_step), who);
  const std::string help =
      by_fraction ? std::string("set stability_fraction = 0.5")
                  : fmt::format("set limiter = \"stability\", which gives every element its own step, or base_step = {}",
                                cases::number_text(stable_base_step(time, shortest.stable_step)));
  if (time.strict) refuse(file, key, what, help);
  return warning(file, key, what, help);
}

namespace {

/// The time in which a motion changes: a twentieth of a period, or the step of a record [s].
Real time_of_change(const cases::Motion& motion) {
  if (motion.type == cases::MotionShape::record) return motion.record.step;
  return motion.type == cases::MotionShape::function ? std::numeric_limits<Real>::infinity() : 0.05 / motion.frequency;
}

std::string warn_of_fast_motions(const cases::CaseFile& file, Real base_step) {
  std::string all;
  const auto& motions = file.as<cases::BlocksCase>().motions;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Real shortest = time_of_change(motions[i]);
    if (base_step <= shortest) continue;
    all += warning(file, fmt::format("motions.{}.name", i),
                   fmt::format("the motion \"{}\" changes within {}, faster than the base step of {}", motions[i].name,
                               seconds(shortest), seconds(base_step)),
                   fmt::format("set time.base_step = {} or less, or give a slower motion", cases::short_number(shortest)));
  }
  return all;
}

}  // namespace

std::string warn_of(const cases::CaseFile& file, const BlocksModel& model) {
  return cases::warn_of_size(file, cases::extent_of(model.mesh.nodes)) + warn_of_mesh_fit(file, model.fit) +
         check_stability(file, model) + warn_of_fast_motions(file, model.simulation->levels().step(0));
}

}  // namespace sazare::runs
