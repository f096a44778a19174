#include "sazare/methods/mps/run/strength_reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ranges>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/mps/run/model.hpp"
#include "sazare/methods/mps/run/settle.hpp"

namespace sazare::runs {

namespace {

// A band of particles that flows hardens a little, so that the displacement does not jump where a slope fails: it begins to grow
// fast. At the factor of safety that finite elements find, it is this many times that of elastic ground.
constexpr Real knee = 1.5;

/// The case with another strength, in search of its equilibrium under gravity.
cases::CaseFile with_strength(const cases::CaseFile& file, const std::optional<Real>& factor) {
  cases::CaseFile changed = file;
  auto& mps = changed.as<cases::MpsCase>();
  mps.gravity.settle = true;
  for (cases::Ground& ground : mps.materials) {
    if (!ground.yields) continue;
    ground.yields = factor.has_value();
    if (!factor) continue;
    const ReducedStrength reduced =
        ReducedStrength{ground.cohesion, ground.friction_angle, ground.dilation_angle, ground.tensile_strength}.over(*factor);
    ground.cohesion = reduced.cohesion;
    const ReducedStrength residual =
        ReducedStrength{ground.residual_cohesion.value_or(0), ground.residual_friction_angle.value_or(0), 0, {}}.over(*factor);
    if (ground.residual_cohesion) ground.residual_cohesion = residual.cohesion;
    if (ground.residual_friction_angle) ground.residual_friction_angle = residual.friction_angle;
    ground.friction_angle = reduced.friction_angle;
    ground.dilation_angle = reduced.dilation_angle;
    ground.tensile_strength = reduced.tensile_strength;
  }
  return changed;
}

template <int D>
Vector3 vector_at(const std::array<state::Column, D>& columns, std::size_t i) {
  Vector3 vector = Vector3::Zero();
  for (std::size_t axis = 0; axis < D; ++axis) vector[static_cast<int>(axis)] = columns[axis][i];
  return vector;
}

/// The largest displacement but for one particle in a hundred: a few may rattle at the surface.
template <int D>
Real displacement_of(const state::Particles<D>& particles) {
  std::vector<Real> squares(particles.size(), 0);
  for (const state::Column& axis : particles.displacement)
    for (std::size_t i = 0; i < squares.size(); ++i) squares[i] += axis[i] * axis[i];
  const auto place = squares.end() - 1 - static_cast<std::ptrdiff_t>(squares.size() / 100);
  std::ranges::nth_element(squares, place);
  return std::sqrt(*place);
}

/// Ground rests when its displacement has stayed the same over the second half of all steps so far, and runs away when it has
/// moved by more than it may.
class DisplacementWatch {
public:
  explicit DisplacementWatch(Real most) : most_(most) {}

  bool is_enough(std::int64_t steps, Real displacement) {
    if (displacement > most_)
      throw PhysicsError(fmt::format("the ground has moved by {} m after {} steps, more than {} m",
                                     cases::short_number(displacement, 3), steps, cases::short_number(most_, 3)));
    seen_.push_back(displacement);
    if (steps < least_steps) return false;
    const auto [low, high] = std::ranges::minmax(seen_ | std::views::drop(seen_.size() / 2));
    return high - low <= steady_share * high;
  }

private:
  static constexpr std::int64_t least_steps = 500;
  static constexpr Real steady_share = 1e-3;

  Real most_;
  std::vector<Real> seen_;  // [m]
};

template <int D>
class ParticleReduction final : public StrengthReduction {
public:
  explicit ParticleReduction(const cases::CaseFile& file) : file_(file) {}

  StrengthTrial try_out(const StrengthTrialRules& rules) override {
    const cases::CaseFile changed = with_strength(file_, rules.factor);
    model_ = build_mps<D>(changed);
    RunOptions options;
    options.quiet = true;
    options.stop = rules.stop;
    StrengthTrial trial;
    const state::Particles<D>& particles = model_->stepper->particles();
    DisplacementWatch watch(rules.most_displacement);
    const auto is_enough = [&](std::int64_t steps) { return watch.is_enough(steps, displacement_of<D>(particles)); };
    try {
      trial.stands = settle<D>(changed.as<cases::MpsCase>(), *model_, options, Rest::fully, is_enough);
    } catch (const PhysicsError& failure) {
      const std::string words = failure.what();
      trial.end = words.substr(0, words.find('\n'));
    }
    trial.displacement = displacement_of<D>(particles);
    if (trial.stands) {
      trial.stands = trial.displacement <= rules.most_displacement;
      trial.end =
          fmt::format("{} moved by {} m", trial.stands ? "at rest," : "runs away,", cases::short_number(trial.displacement, 3));
    }
    return trial;
  }

  std::vector<MovedGround> ground() const override {
    std::vector<MovedGround> found;
    if (!model_) return found;
    const state::Particles<D>& particles = model_->stepper->particles();
    for (std::size_t i = 0; i < particles.size(); ++i)
      found.push_back({vector_at<D>(particles.start, i), vector_at<D>(particles.displacement, i),
                       model_->failing != nullptr ? model_->failing->strength().slip()[i] : 0});
    return found;
  }

  Real usual_displacement_ratio() const override { return knee; }
  std::string warning() const override { return model_ ? model_->warning : ""; }
  std::int64_t size() const override { return model_ ? std::ssize(model_->filling.sites) : 0; }

private:
  const cases::CaseFile& file_;
  std::optional<MpsModel<D>> model_;
};

}  // namespace

std::unique_ptr<StrengthReduction> reduce_strength_of_mps(const cases::CaseFile& file) {
  const auto& mps = file.as<cases::MpsCase>();
  if (mps.gravity.acceleration.norm() == 0)
    refuse(file, "gravity", "without gravity no ground slides, and there is no factor of safety", "give gravity an acceleration");
  for (std::size_t i = 0; i < mps.materials.size(); ++i)
    if (mps.materials[i].degrades)
      refuse(file, fmt::format("materials.{}.backbone", i),
             fmt::format("the strength of soil that degrades with strain (\"{}\") cannot be divided", mps.materials[i].name),
             "for the factor of safety give it a cohesion and a friction_angle instead");
  if (std::ranges::none_of(mps.materials, &cases::Ground::yields))
    refuse(file, "materials", "no material has a strength, so there is nothing to divide", "give the ground a cohesion");
  if (mps.particles.dimension == 2) return std::make_unique<ParticleReduction<2>>(file);
  return std::make_unique<ParticleReduction<3>>(file);
}

}  // namespace sazare::runs
