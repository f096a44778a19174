#pragma once

/// From a checked case of method mps to particles that can be stepped.

#include <memory>
#include <optional>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/mps/case/case.hpp"
#include "sazare/methods/mps/failing_forces.hpp"
#include "sazare/methods/mps/free_field.hpp"
#include "sazare/methods/mps/ground_at_surface.hpp"
#include "sazare/methods/mps/run/filling.hpp"
#include "sazare/methods/mps/run/softening_ground.hpp"
#include "sazare/methods/mps/stable_step.hpp"
#include "sazare/particles/uniform_stepper.hpp"

namespace sazare::runs {

/// What a coupling asks of the ground.
struct MpsCoupling {
  Real window = 0;    ///< which a step that the case does not give divides [s]
  Real friction = 0;  ///< between ground and surface [-]
};

/// The limit of the integrator of a case [s].
inline Real limit_of(const methods::mps::StableStep& limit, const cases::MpsTime& time) {
  if (time.integrator != cases::Integrator::euler) return limit.verlet;
  return time.euler_damping == cases::EulerDamping::lagged ? limit.euler_lagged : limit.euler;
}

template <int D>
struct MpsModel {
  Filling<D> filling;
  std::vector<Index> material;     ///< by particle
  Real number_density = 0;         ///< n0 [-]
  methods::mps::StableStep limit;  ///< predicted
  Real step = 0;                   ///< [s]
  std::vector<std::string> sides;  ///< what each boundary holds, ready to print
  std::string warning;             ///< about the step, ready to print; empty when there is none
  std::unique_ptr<particles::UniformStepper<D>> stepper;
  const methods::mps::FailingForces<D>* failing = nullptr;  ///< of the stepper's forces, where the ground has a strength
  const methods::mps::LinkTable<D>* links = nullptr;        ///< of the stepper's forces, as they are now
  methods::mps::GroundAtSurface<D>* at_surface = nullptr;   ///< of the stepper's forces, in a coupling
  methods::mps::FreeFieldForces<D>* free_field = nullptr;   ///< the stepper's forces, where there are free-field sides

  /// The predicted limit of the case's integrator [s].
  Real stable_step(const cases::MpsTime& time) const { return limit_of(limit, time); }
};

/// What the particles of each material of a case are made of.
std::vector<methods::mps::StrengthOfGround> strengths_of(const cases::MpsCase& mps, const SofteningPlace& place);

/// What a model is made of, before a step is chosen.
template <int D>
struct MpsParts {
  Filling<D> filling;
  methods::mps::Site<D> period{};  ///< length along periodic axes, in spacings; 0 along the others
  std::vector<Index> material;
  state::Particles<D> particles;
  methods::mps::LinkTable<D> links;
  particles::ParticleSupports<D> supports;
  std::vector<std::string> sides;  ///< what each boundary holds, ready to print
  laws::RayleighDamping damping;

  methods::mps::StableStep predict() const { return methods::mps::stable_step<D>(particles, links, supports, damping); }
  std::unique_ptr<particles::ParticleForces<D>> forces(const cases::MpsCase& mps, Real step) const;
  std::unique_ptr<particles::UniformStepper<D>> stepper(const cases::MpsCase& mps, Real step,
                                                        std::unique_ptr<particles::ParticleForces<D>> forces) const;
};

/// Particles and links of ground that nothing holds.
template <int D>
MpsParts<D> lay_out(const cases::MpsCase& mps, Filling<D> filling, const methods::mps::Site<D>& period);

/// Throws UserError when the case does not fit its particles.
template <int D>
MpsParts<D> make_parts(const cases::CaseFile& file);

/// Builds the model and chooses the step, or throws UserError when the one given is above the predicted limit.
template <int D>
MpsModel<D> build_mps(const cases::CaseFile& file, const std::optional<MpsCoupling>& coupling = std::nullopt);

extern template struct MpsParts<2>;
extern template struct MpsParts<3>;
extern template MpsParts<2> lay_out<2>(const cases::MpsCase&, Filling<2>, const methods::mps::Site<2>&);
extern template MpsParts<3> lay_out<3>(const cases::MpsCase&, Filling<3>, const methods::mps::Site<3>&);
extern template MpsParts<2> make_parts<2>(const cases::CaseFile&);
extern template MpsParts<3> make_parts<3>(const cases::CaseFile&);
extern template MpsModel<2> build_mps<2>(const cases::CaseFile&, const std::optional<MpsCoupling>&);
extern template MpsModel<3> build_mps<3>(const cases::CaseFile&, const std::optional<MpsCoupling>&);

}  // namespace sazare::runs
