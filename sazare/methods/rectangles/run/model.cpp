#include "sazare/methods/rectangles/run/model.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/rectangles/case/case.hpp"
#include "sazare/observe/hash.hpp"

namespace sazare::runs {

namespace {

constexpr Real near_limit = 0.95;  // above it a run is stable, but barely

/// The step of a run, which divides the history interval, or the shorter windows of a coupling.
Real choose_step(const cases::RectanglesCase& rectangles, Real limit, std::optional<Real> window) {
  const cases::UniformTime& time = rectangles.time;
  if (time.step) return *time.step;
  const Real interval = window.value_or(time.history_interval);
  return interval / std::ceil(interval / (time.stability_fraction * limit));
}

/// Refuses a step above the limit, and warns of one that is close to it.
std::string check_step(const cases::CaseFile& file, const RectanglesModel& model) {
  const Real limit = model.limit.limit;
  const std::string what =
      fmt::format("the step of {} s is {} times the predicted limit of {} s", cases::short_number(model.step, 4),
                  cases::short_number(model.step / limit, 4), cases::short_number(limit, 4));
  const std::string paper =
      model.limit.paper > 0 ? fmt::format("; (26) of the paper gives {} s", cases::short_number(model.limit.paper, 3)) : "";
  if (!(model.step <= limit))  // so is a limit that is no number
    refuse(file, "time.step", what,
           fmt::format("choose {} s or less, or give no step{}", cases::short_number(near_limit * limit, 3), paper));
  if (model.step > near_limit * limit)
    return warning(file, "time.step", what, "0.8 of it leaves a margin for large motion");
  return {};
}

}  // namespace

RectanglesModel build_rectangles(const cases::CaseFile& file, std::optional<Real> window) {
  using methods::rectangles::RectangleForces;
  const cases::RectanglesCase& rectangles = file.as<cases::RectanglesCase>();
  Assembly assembly = assemble(file);
  RectanglesModel model;
  model.elements = assembly.elements;
  model.case_block = assembly.case_block;
  const bool may_touch = assembly.parts.supports > 0 || assembly.case_block.size() > 1 || window;
  {
    const RectangleForces forces(assembly.particles, assembly.parts, 1);
    model.limit = methods::rectangles::stable_step(assembly.particles, forces.outlines(), forces.links(), assembly.parts.contact,
                                                   may_touch);
  }
  model.step = choose_step(rectangles, model.limit.limit, window);
  model.warning = check_step(file, model);
  auto forces = std::make_unique<RectangleForces>(assembly.particles, std::move(assembly.parts), model.step);
  model.forces = forces.get();
  model.stepper = std::make_unique<particles::UniformStepper<2>>(
      std::move(assembly.particles), std::move(forces), std::move(assembly.supports),
      particles::UniformRules{model.step, particles::Integrator::leapfrog, {}});
  return model;
}

std::string assembly_hash(const state::Particles<2>& particles) {
  observe::Hash hash;
  for (const state::Column* column : {&particles.start[0], &particles.start[1], &particles.angle})
    hash.add(std::as_bytes(std::span(*column)));
  return observe::to_hex(hash.value());
}

}  // namespace sazare::runs
