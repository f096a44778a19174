#include "sazare/methods/mps/run/settle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/runs/progress.hpp"

namespace sazare::runs {

namespace {

constexpr std::int64_t check_steps = 50;
constexpr Real relaxed_share = 1e-5;   // of gravity
constexpr Real creeping_share = 1e-4;  // of gravity: ground close to its strength creeps for long, and does not slide
constexpr Real rattling_share = 3e-4;  // of gravity: on a surface particles come and go between two steps for long

using cases::short_number;

template <int D>
std::string place_words(const MpsModel<D>& model, Index particle) {
  const Vector<D> place = model.filling.place(at(particle));
  std::string text = "(";
  for (int axis = 0; axis < D; ++axis) text += (axis > 0 ? ", " : "") + short_number(place[axis]);
  return text + ") m";
}

/// Looks for ground that has broken and slides since.
template <int D>
class SlideSearch {
public:
  explicit SlideSearch(const MpsModel<D>& model) : model_(&model) {}

  /// A particle that has moved by more than a spacing since it broke.
  std::optional<Index> find() {
    if (model_->failing == nullptr) return {};
    const auto& particles = model_->stepper->particles();
    for (const Index particle : model_->failing->gathered().particles()) {
      Vector<D> now;
      for (std::size_t axis = 0; axis < D; ++axis) now[static_cast<int>(axis)] = particles.displacement[axis][at(particle)];
      const auto [found, is_new] = broke_at_.try_emplace(particle, now);
      if (!is_new && (now - found->second).norm() > particles.spacing) return particle;
    }
    return {};
  }

private:
  const MpsModel<D>* model_;
  std::map<Index, Vector<D>> broke_at_;  ///< displacement when first found broken [m]
};

std::string words_of_rest(std::int64_t steps, Real left, Real tolerance) {
  return fmt::format("after {} steps an acceleration of {} m/s2 remains, {} is required", steps, short_number(left, 3),
                     short_number(tolerance, 3));
}

bool is_stopped(const RunOptions& options) { return options.stop.is_made(); }

/// The columns beside free-field sides come to rest before the ground does, which they carry. False when asked to stop.
template <int D>
bool settle_columns(const cases::MpsCase& mps, MpsModel<D>& model, Real tolerance, const RunOptions& options) {
  for (std::size_t i = 0; model.free_field != nullptr && i < model.free_field->column_count(); ++i) {
    const auto goes_on = [&](std::int64_t, Real) { return !is_stopped(options); };
    const Real left = model.free_field->relax(i, {tolerance, mps.gravity.max_settling_steps, goes_on});
    if (is_stopped(options)) return false;
    if (!(left <= std::max(tolerance, creeping_share * mps.gravity.acceleration.norm())))
      throw PhysicsError(
          fmt::format("no equilibrium under gravity of the column beside free-field side {}: {}\n"
                      "  its layers do not carry their own weight: check their strength and the boundary below them",
                      i + 1, words_of_rest(mps.gravity.max_settling_steps, left, tolerance)));
  }
  return true;
}

}  // namespace

template <int D>
bool settle(const cases::MpsCase& mps, MpsModel<D>& model, const RunOptions& options, Rest rest,
            const std::function<bool(std::int64_t steps)>& is_enough) {
  if (!mps.gravity.settle) return true;
  const Real gravity = mps.gravity.acceleration.norm();
  const Real tolerance = (rest == Rest::nearly ? rattling_share : relaxed_share) * gravity,
             accepted = (model.at_surface != nullptr ? rattling_share : creeping_share) * gravity;
  const auto particles = static_cast<std::int64_t>(model.filling.sites.size());
  if (!options.quiet) fmt::print("finding the equilibrium under gravity\n");
  std::fflush(stdout);
  if (!settle_columns<D>(mps, model, tolerance, options)) return false;
  SlideSearch<D> search(model);
  std::optional<Index> slides;
  Progress progress(options.quiet, {.smallest_step = model.step, .broken_joints = -1, .evaluated = "particle-steps"});
  Real first = 0;
  bool asked = false, enough = false;
  const auto goes_on = [&](std::int64_t done, Real left) {
    first = std::max(first, left);
    // What is left falls by about the same factor in equal times.
    if (progress.is_due())
      progress.show(
          {std::log(first / left) / std::log(first / tolerance), 0, done * particles, model.step, -1, "particle-steps"});
    asked = is_stopped(options);
    if (done % check_steps == 0) {
      slides = search.find();
      enough = is_enough && is_enough(done);
    }
    return !asked && !slides && !enough;
  };
  const Real left = model.stepper->relax({tolerance, mps.gravity.max_settling_steps, goes_on});
  if (asked) return false;
  if (!slides) slides = search.find();
  if (slides)
    throw PhysicsError(fmt::format(
        "no equilibrium under gravity: the ground at {} broke and has moved by more than a spacing since\n"
        "  the ground slides under its own weight: check its strength and its shape, or run it without settle to see the slide",
        place_words<D>(model, *slides)));
  if (left <= tolerance || enough) return true;
  const std::string after = words_of_rest(mps.gravity.max_settling_steps, left, tolerance);
  if (left <= accepted) {
    if (!options.quiet) fmt::print("the equilibrium under gravity is all but reached: {}\n", after);
    return true;
  }
  throw PhysicsError(
      fmt::format("no equilibrium under gravity: {}\n"
                  "  the ground is not stable, or hardly supported: check its strength and the boundaries that support it",
                  after));
}

template bool settle<2>(const cases::MpsCase&, MpsModel<2>&, const RunOptions&, Rest, const std::function<bool(std::int64_t)>&);
template bool settle<3>(const cases::MpsCase&, MpsModel<3>&, const RunOptions&, Rest, const std::function<bool(std::int64_t)>&);

}  // namespace sazare::runs
