/// The energy balance of UniformStepper: work by cause.

#include <algorithm>

#include "sazare/particles/uniform_stepper.hpp"

namespace sazare::particles {

template <int D>
bool UniformStepper<D>::is_damped() const {
  const auto is_above_zero = [](Real ratio) { return ratio > 0; };
  return (rules_.damping.mass_rate > 0 || rules_.damping.stiffness_time > 0) &&
         std::ranges::any_of(particles_.damping_ratio, is_above_zero);
}

/// Velocity after the coming kick of a degree of freedom that is free to move.
template <int D>
Real UniformStepper<D>::velocity_after(std::size_t freedom, std::size_t i) const {
  return keep_[freedom][i] * particles_.velocity[freedom][i] +
         gain_[freedom][i] * (total_acceleration(freedom, i) + load_[freedom][i] + carried(freedom, i));
}

template <int D>
Real UniformStepper<D>::velocity_after(const particles::DrivenFreedom& driven) const {
  const Real next = driven.factor * supports_.motions[at(driven.motion)].at(time() + rules_.step).displacement;
  return (next - particles_.displacement[static_cast<std::size_t>(driven.freedom)][at(driven.particle)]) / rules_.step;
}

/// Power of the external forces at the present velocities; degrees of freedom that are held receive none.
template <int D>
Real UniformStepper<D>::applied_power() const {
  Real power = 0;
  for (std::size_t axis = 0; axis < D && !applied_[0].empty(); ++axis)
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (applied_[axis][i] != 0 && gain_[axis][i] > 0)
        power += applied_[axis][i] * particles_.velocity[axis][i] / particles_.inverse_mass[i];
  return power;
}

template <int D>
void UniformStepper<D>::remember_supports() {
  support_work_.applied += 0.5 * rules_.step * applied_power();
  before_kick_.clear();
  const auto velocity = [&](const auto& support) {
    return particles_.velocity[static_cast<std::size_t>(support.freedom)][at(support.particle)];
  };
  for (const particles::Dashpot& dashpot : supports_.dashpots) before_kick_.push_back(velocity(dashpot));
  for (const particles::DrivenFreedom& driven : supports_.driven) before_kick_.push_back(velocity(driven));
}

/// The kick has been given, the forces are still those that gave it.
template <int D>
void UniformStepper<D>::add_work_of_supports() {
  support_work_.applied += 0.5 * rules_.step * applied_power();
  auto before = before_kick_.begin();
  const auto after = [&](const auto& support) {
    return particles_.velocity[static_cast<std::size_t>(support.freedom)][at(support.particle)];
  };
  for (const particles::Dashpot& dashpot : supports_.dashpots) {
    add_work_of_boundary(dashpot, *before, after(dashpot), 0.5 * (*before + after(dashpot)), support_work_);
    ++before;
  }
  for (const particles::DrivenFreedom& driven : supports_.driven) {
    add_work_of_prescribed(driven, *before, after(driven), 0.5 * (*before + after(driven)), support_work_);
    ++before;
  }
}

/// `way` is over the step. The columns count its drag as damping.
template <int D>
void UniformStepper<D>::add_work_of_boundary(const particles::Dashpot& dashpot, Real before, Real after, Real way,
                                      WorkByCause& work) const {
  const auto freedom = static_cast<std::size_t>(dashpot.freedom);
  const Real impulse = rules_.step / particles_.inverse_inertia_of(freedom)[at(dashpot.particle)];
  const Real drag = dashpot.rate * 0.5 * (before + after);
  const Real gravity = dashpot.freedom < D ? supports_.gravity[dashpot.freedom] : 0;
  const Real others = gravity + applied_to(freedom, at(dashpot.particle));
  work.boundary += impulse * way * (load_[freedom][at(dashpot.particle)] - others - drag);
  if (!damping_work_[0].empty()) work.damping += impulse * way * drag;
}

/// The support gives what the change of velocity needs besides all other forces.
template <int D>
void UniformStepper<D>::add_work_of_prescribed(const particles::DrivenFreedom& driven, Real before, Real after, Real way,
                                        WorkByCause& work) const {
  const auto freedom = static_cast<std::size_t>(driven.freedom);
  const std::size_t i = at(driven.particle);
  const Real inverse = particles_.inverse_inertia_of(freedom)[i];
  if (!(inverse > 0)) return;
  const Real gravity = driven.freedom < D ? supports_.gravity[driven.freedom] : 0;
  const Real total = total_acceleration(freedom, i), damping = total - elastic_[freedom][i];
  work.prescribed += way * (after - before - rules_.step * (total + gravity)) / inverse;
  work.damping += way * rules_.step * damping / inverse;
}

/// What the coming kick does in the step that has been.
template <int D>
WorkByCause UniformStepper<D>::first_half_of_kick() const {
  WorkByCause half;
  half.applied = 0.5 * rules_.step * applied_power();
  for (std::size_t freedom = 0; freedom < keep_.size() && !damping_work_[0].empty(); ++freedom)
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      if (!(gain_[freedom][i] > 0)) continue;
      const Real before = particles_.velocity[freedom][i];
      const Real damping = velocity_after(freedom, i) - before - rules_.step * (elastic_[freedom][i] + load_[freedom][i]);
      const Real base = base_velocity_[freedom];
      half.damping += 0.5 * (before - base) * damping / particles_.inverse_inertia_of(freedom)[i];
      half.prescribed += 0.5 * base * damping / particles_.inverse_inertia_of(freedom)[i];
    }
  for (const particles::Dashpot& dashpot : supports_.dashpots) {
    const auto freedom = static_cast<std::size_t>(dashpot.freedom);
    const Real before = particles_.velocity[freedom][at(dashpot.particle)];
    add_work_of_boundary(dashpot, before, velocity_after(freedom, at(dashpot.particle)), 0.5 * before, half);
  }
  for (const particles::DrivenFreedom& driven : supports_.driven) {
    const Real before = particles_.velocity[static_cast<std::size_t>(driven.freedom)][at(driven.particle)];
    add_work_of_prescribed(driven, before, velocity_after(driven), 0.5 * before, half);
  }
  return half;
}

template <int D>
WorkByCause UniformStepper<D>::work() const {
  if (!has_energy_balance()) return {};
  WorkByCause sum = first_half_of_kick();
  sum.boundary += support_work_.boundary;
  sum.prescribed += support_work_.prescribed;
  sum.damping += support_work_.damping;
  sum.applied += support_work_.applied;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    if (!(particles_.inverse_mass[i] > 0)) continue;  // moved by others, whatever its weight
    if (!damping_work_[0].empty()) {
      sum.damping += damping_work_[0][i] / particles_.inverse_mass[i] + damping_work_[1][i] / particles_.inverse_inertia[i];
      sum.prescribed += base_work_[i] / particles_.inverse_mass[i];
    }
    for (std::size_t axis = 0; axis < D; ++axis)
      sum.gravity += supports_.gravity[static_cast<int>(axis)] *
                     (particles_.displacement[axis][i] - initial_displacement_[axis][i]) / particles_.inverse_mass[i];
  }
  return sum;
}

template <int D>
Real UniformStepper<D>::kinetic_energy_of_kick() const {
  Real total = 0;
  for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom)
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (gain_[freedom][i] > 0)
        total += 0.5 * particles_.velocity[freedom][i] * velocity_after(freedom, i) / particles_.inverse_inertia_of(freedom)[i];
  for (const particles::DrivenFreedom& driven : supports_.driven) {
    const auto freedom = static_cast<std::size_t>(driven.freedom);
    const Real inverse = particles_.inverse_inertia_of(freedom)[at(driven.particle)];
    if (inverse > 0) total += 0.5 * particles_.velocity[freedom][at(driven.particle)] * velocity_after(driven) / inverse;
  }
  return total;
}

// The class is instantiated in uniform_stepper.cpp, without these.
#define SAZARE_INSTANTIATE_ENERGY(D)                                                                                    \
  template bool UniformStepper<D>::is_damped() const;                                                                  \
  template Real UniformStepper<D>::velocity_after(std::size_t, std::size_t) const;                                     \
  template Real UniformStepper<D>::velocity_after(const particles::DrivenFreedom&) const;                                  \
  template Real UniformStepper<D>::applied_power() const;                                                              \
  template void UniformStepper<D>::remember_supports();                                                                \
  template void UniformStepper<D>::add_work_of_supports();                                                                    \
  template void UniformStepper<D>::add_work_of_boundary(const particles::Dashpot&, Real, Real, Real, WorkByCause&) const;         \
  template void UniformStepper<D>::add_work_of_prescribed(const particles::DrivenFreedom&, Real, Real, Real, WorkByCause&) const; \
  template WorkByCause UniformStepper<D>::first_half_of_kick() const;                                                  \
  template WorkByCause UniformStepper<D>::work() const;                                                                \
  template Real UniformStepper<D>::kinetic_energy_of_kick() const;

SAZARE_INSTANTIATE_ENERGY(2)
SAZARE_INSTANTIATE_ENERGY(3)
#undef SAZARE_INSTANTIATE_ENERGY

}  // namespace sazare::particles
