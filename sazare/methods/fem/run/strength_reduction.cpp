#include "sazare/methods/fem/run/strength_reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"
#include "sazare/methods/fem/run/model.hpp"
#include "sazare/runs/temporary_folder.hpp"

namespace sazare::runs {

namespace {

constexpr Real boundless = 1e30;  // Pa, cohesion of a joint that never slips

/// The case with another strength of its ground and joints.
cases::CaseFile with_strength(const cases::CaseFile& file, const std::optional<Real>& factor) {
  cases::CaseFile changed = file;
  auto& fem = changed.as<cases::FemCase>();
  for (cases::FemMaterial& material : fem.materials) {
    if (!material.yields) continue;
    material.yields = factor.has_value();
    if (!factor) continue;
    const ReducedStrength reduced =
        ReducedStrength{material.cohesion, material.friction_angle, material.dilation_angle, material.tensile_strength}.over(
            *factor);
    material.cohesion = reduced.cohesion;
    material.friction_angle = reduced.friction_angle;
    material.dilation_angle = reduced.dilation_angle;
    material.tensile_strength = reduced.tensile_strength;
  }
  for (cases::FemJoint& joint : fem.joints) {
    const ReducedStrength reduced = ReducedStrength{joint.cohesion, joint.friction_angle, 0, {}}.over(factor.value_or(1));
    joint.cohesion = factor ? reduced.cohesion : boundless;
    joint.friction_angle = reduced.friction_angle;
  }
  return changed;
}

template <int D>
class ElementReduction final : public StrengthReduction {
public:
  explicit ElementReduction(const cases::CaseFile& file) : file_(file) {}

  StrengthTrial try_out(const StrengthTrialRules& rules) override {
    const cases::CaseFile changed = with_strength(file_, rules.factor);
    model_ = build_fem<D>(changed, load_fem_mesh(changed, folder_.path() / "mesh.msh", true));
    StrengthTrial trial;
    try {
      trial.stands = find_equilibrium(changed.as<cases::FemCase>(), rules);
    } catch (const PhysicsError& failure) {
      const std::string words = failure.what();
      trial.end = words.substr(0, words.find('\n'));
    }
    trial.displacement = largest_displacement();
    if (!trial.stands) return trial;
    trial.stands = trial.displacement <= rules.most_displacement;
    trial.end = fmt::format("{}, moved by {} m", trial.stands ? "in equilibrium" : "runs away",
                            cases::short_number(trial.displacement, 3));
    return trial;
  }

  std::vector<MovedGround> ground() const override {
    std::vector<MovedGround> found;
    if (!model_) return found;
    const auto& state = model_->stepper->state();
    const auto means = model_->stepper->body().means(state.displacement, state.memory);
    for (std::size_t element = 0; element < means.size(); ++element) {
      MovedGround& at_center = found.emplace_back();
      const auto nodes = model_->mesh().elements[element].node_list();
      const Real share = 1 / static_cast<Real>(nodes.size());
      for (const Index node : nodes) {
        at_center.place += share * model_->mesh().nodes[at(node)];
        at_center.displacement += share * displacement(at(node));
      }
      at_center.slip = means[element].slip;
    }
    return found;
  }

  /// What has no equilibrium has failed, and nothing else.
  Real usual_displacement_ratio() const override { return std::numeric_limits<Real>::infinity(); }
  std::int64_t size() const override { return model_ ? std::ssize(model_->mesh().elements) : 0; }

private:
  /// Under gravity, which is put on in parts where the whole does not converge, and in a static analysis also under all loads to
  /// its end. False when asked to stop.
  bool find_equilibrium(const cases::FemCase& fem, const StrengthTrialRules& rules) {
    methods::fem::FemStepper<D>& stepper = *model_->stepper;
    stepper.relax();
    if (fem.time.analysis != cases::Analysis::statics) return true;
    stepper.start();
    const auto steps = static_cast<std::int64_t>(std::llround(fem.time.end / model_->step));
    while (stepper.steps() < steps) {
      if (rules.stop.is_made()) return false;
      stepper.advance();
    }
    return true;
  }

  Vector3 displacement(std::size_t node) const {
    Vector3 moved = Vector3::Zero();
    for (int axis = 0; axis < D; ++axis)
      moved[axis] = model_->stepper->state().displacement[node * D + static_cast<std::size_t>(axis)];
    return moved;
  }

  Real largest_displacement() const {
    Real largest = 0;
    for (std::size_t node = 0; node < model_->mesh().nodes.size(); ++node) largest = std::max(largest, displacement(node).norm());
    return largest;
  }

  const cases::CaseFile& file_;
  TemporaryFolder folder_;  ///< of the mesh that gmsh makes
  std::optional<FemModel<D>> model_;
};

}  // namespace

std::unique_ptr<StrengthReduction> reduce_strength_of_fem(const cases::CaseFile& file) {
  const auto& fem = file.as<cases::FemCase>();
  if (fem.gravity.acceleration.norm() == 0)
    refuse(file, "gravity", "without gravity no ground slides, and there is no factor of safety", "give gravity an acceleration");
  for (std::size_t i = 0; i < fem.materials.size(); ++i)
    if (fem.materials[i].degrades)
      refuse(file, fmt::format("materials.{}.backbone", i),
             fmt::format("the strength of soil that degrades with strain (\"{}\") cannot be divided", fem.materials[i].name),
             "for the factor of safety give it a cohesion and a friction_angle instead");
  if (fem.joints.empty() && std::ranges::none_of(fem.materials, &cases::FemMaterial::yields))
    refuse(file, "materials", "no material or joint has a strength, so there is nothing to divide", "give the ground a cohesion");
  if (fem.mesh.dimension == 2) return std::make_unique<ElementReduction<2>>(file);
  return std::make_unique<ElementReduction<3>>(file);
}

}  // namespace sazare::runs
