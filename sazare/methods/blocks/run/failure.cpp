#include "sazare/methods/blocks/run/failure.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/check/stability.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::runs {

namespace {

constexpr std::size_t serial_below = 1024;

/// Whether an element is strained by so little that it cannot be turned inside out.
bool is_hardly_strained(const state::Bodies<3>& bodies, std::size_t element) {
  constexpr Real safe_strain = 0.9;
  return bodies.strain.empty() || bodies.strain[element].strain.squaredNorm() <= safe_strain * safe_strain;
}

/// Whether the strain of an element has turned it inside out, or is no number.
bool is_turned_inside_out(const state::Bodies<3>& bodies, Index element) {
  if (is_hardly_strained(bodies, at(element))) return false;
  const Matrix3 strain = tensor_of(bodies.strain[at(element)].strain);
  return !(Eigen::SelfAdjointEigenSolver<Matrix3>(strain, Eigen::EigenvaluesOnly).eigenvalues()[0] > -1);
}

/// Quickly, of all elements at every base step: none that has failed passes as sound. What is no number in any momentum is none
/// in the rotation after the next drift, or in the velocity.
bool is_sound(const state::Motion<3>& motion, Real reach, Real longest_step) {
  return motion.velocity.squaredNorm() * longest_step * longest_step <= reach * reach && std::isfinite(motion.rotation(0, 0));
}

bool has_failed(const BlocksModel& model, Index element) {
  const auto& simulation = *model.simulation;
  const state::Motion<3>& motion = simulation.bodies().motion[at(element)];
  const Real farthest = simulation.bodies().reach[at(element)];
  const Real step = simulation.levels().step(simulation.levels().level(element));
  return !(motion.velocity.squaredNorm() * step * step <= farthest * farthest) || !state::is_finite(motion) ||
         is_turned_inside_out(simulation.bodies(), element);
}

/// The element that is likely to have failed first: the one whose step is farthest above its limit, as failure spreads.
Index likely_first(const BlocksModel& model) {
  const auto& simulation = *model.simulation;
  Index worst = -1;
  Real highest = -1;
  for (Index element = 0; element < simulation.bodies().size(); ++element) {
    if (!has_failed(model, element)) continue;
    const Real share = simulation.levels().step(simulation.levels().level(element)) / model.stable_step[at(element)];
    if (share <= highest) continue;
    highest = share;
    worst = element;
  }
  return worst;
}

/// The longest step that the rules of a case let an element take.
Real longest_step(const BlocksModel& model, const cases::Time& time, Index element) {
  const Real base = model.simulation->levels().step(0);
  return time.limiter == cases::Limiter::stability ? std::min(base, time.stability_fraction * model.stable_step[at(element)])
                                                   : base;
}

/// Where any element may take a step above its limit, what that is; it may have been another one, or have been refined since.
std::string step_above_limit(const BlocksModel& model, const cases::Time& time) {
  Index worst = -1;
  Real highest = 1 + 1e-9;
  for (Index element = 0; element < model.simulation->bodies().size(); ++element)
    if (const Real share = longest_step(model, time, element) / (stable_share * model.stable_step[at(element)]); share > highest) {
      highest = share;
      worst = element;
    }
  if (worst < 0) return {};
  return fmt::format("the step may be {} s long, which is {} times the stability limit ({} s) of {}",
                     cases::short_number(longest_step(model, time, worst), 3), cases::short_number(highest, 3),
                     cases::short_number(stable_share * model.stable_step[at(worst)], 3), element_text(model.mesh, worst));
}

std::string likely_reason(const BlocksModel& model, const cases::CaseFile& file, Index element) {
  const LimitingElement smallest = limiting_elements(model, 1).front();
  const Real step = model.simulation->levels().step(model.simulation->levels().level(element));
  const Real limit = stable_share * model.stable_step[at(element)];
  const std::string cure = file.as<cases::BlocksCase>().time.limiter == cases::Limiter::stability
                               ? "set time.stability_fraction = 0.25"
                               : fmt::format("set time.limiter = \"stability\", or time.base_step to {} s at most",
                                             cases::short_number(stable_share * smallest.stable_step, 3));
  if (step > limit)
    return fmt::format("its step of {} s is {} times the stability limit ({} s) from the {} of its joints and boundaries: {}",
                       cases::short_number(step, 3), cases::short_number(step / limit, 3),
                       cases::short_number(limit, 3), bound_by_dashpots(model, element) ? "dashpots" : "springs", cure);
  if (const std::string above = step_above_limit(model, file.as<cases::BlocksCase>().time); !above.empty())
    return fmt::format("{}: {}", above, cure);
  if (file.as<cases::BlocksCase>().contact.damping_cap == cases::DampingCap::literal)
    return "its step is stable for its joints; the dashpot of its contacts is not capped and may be too stiff for the step: set "
           "contact.damping_cap = \"step\"";
  if (is_turned_inside_out(model.simulation->bodies(), element))
    return "the loads on it (pressures in Pa, initial stress, speeds) are far beyond what an elastic element can carry: check "
           "them "
           "and youngs_modulus";
  return "its step is stable for its joints and boundaries; check the loads on it (pressures, gravity, water, moving boundaries) "
         "and "
         "the stiffness of its contacts, or set a shorter time.base_step";
}

}  // namespace

Index find_failed_element(BlocksModel& model) {
  const state::Bodies<3>& bodies = model.simulation->bodies();
  const Index count = bodies.size();
  const auto fails_here = [&](Index element) { return model.simulation->owns(element) && has_failed(model, element); };
  const Real longest_step = model.simulation->levels().step(0);
  std::atomic<bool> some_failed = false;
  parallel::parallel_for(at(count), serial_below, [&](std::size_t begin, std::size_t end) {
    for (std::size_t element = begin; element < end; ++element) {
      const bool sound =
          is_sound(bodies.motion[element], bodies.reach[element], longest_step) && is_hardly_strained(bodies, element);
      if (!sound && fails_here(static_cast<Index>(element))) some_failed = true;
    }
  });
  std::vector<Index> failed;
  for (Index element = 0; some_failed && failed.empty() && element < count; ++element)
    if (fails_here(element)) failed.push_back(element);
  model.simulation->unite(failed);
  if (failed.empty()) return -1;
  model.simulation->collect();
  return failed.front();
}

std::string describe_failure(const BlocksModel& model, const cases::CaseFile& file, Real time) {
  const Index element = likely_first(model);
  const state::Motion<3>& motion = model.simulation->bodies().motion[at(element)];
  std::string what = "has a motion that is no longer a number";
  if (state::is_finite(motion))
    what = is_turned_inside_out(model.simulation->bodies(), element)
               ? std::string("has been turned inside out by its strain")
               : fmt::format("moves at {} m/s, farther in one step than its own size",
                             cases::short_number(motion.velocity.norm(), 3));
  return fmt::format("{} (initial position) {}, found at t = {} s\n  {}", element_text(model.mesh, element), what,
                     cases::short_number(time), likely_reason(model, file, element));
}

}  // namespace sazare::runs
