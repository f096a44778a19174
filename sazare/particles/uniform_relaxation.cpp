/// How UniformStepper finds equilibrium before the beginning.

#include <algorithm>
#include <cmath>

#include "sazare/particles/uniform_stepper.hpp"

namespace sazare::particles {

/// From now on, from rest.
template <int D>
void UniformStepper<D>::stand_still() {
  for (state::Column& column : particles_.velocity) std::ranges::fill(column, 0);
  begin_halfway();
}

template <int D>
Real UniformStepper<D>::relax(const RelaxationRules& rules) {
  const auto velocity = particles_.velocity;
  for (const particles::Dashpot& dashpot : supports_.dashpots)
    if (!dashpot.settles) hold(dashpot.particle, dashpot.freedom);
  find_even_tiles();
  drive();
  forces_->evaluate(particles_, elastic_);
  previous_ = elastic_;
  stand_still();
  Real before = 0, left = largest_unbalance();
  for (std::int64_t i = 0; i < rules.most_steps && left > rules.tolerance; ++i) {
    step_ = -1;  // so that the time stays 0
    kick_and_drift();
    const Real now = kinetic_sum();
    if (now < before) stand_still();
    before = now < before ? 0 : now;
    left = largest_unbalance();
    if (!rules.goes_on(i + 1, left)) break;
  }
  for (particles::Dashpot& dashpot : supports_.dashpots) {
    if (dashpot.settles) continue;
    const auto freedom = static_cast<std::size_t>(dashpot.freedom);
    dashpot.reaction = -elastic_[freedom][at(dashpot.particle)] - (dashpot.freedom < D ? supports_.gravity[dashpot.freedom] : 0) -
                       applied_to(freedom, at(dashpot.particle));
  }
  initial_displacement_ = particles_.displacement;
  particles_.velocity = velocity;
  prepare_factors();
  return left;
}

template <int D>
Real UniformStepper<D>::kinetic_sum() const {
  Real total = 0;
  for (std::size_t freedom = 0; freedom < keep_.size(); ++freedom)
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      const Real speed = particles_.velocity[freedom][i];
      total += 0.5 * speed * speed / particles_.inverse_inertia_of(freedom)[i];
    }
  return total;
}

template <int D>
Real UniformStepper<D>::largest_unbalance() const {
  Real largest = 0;
  for (std::size_t axis = 0; axis < D; ++axis)
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (gain_[axis][i] > 0)
        largest =
            std::max(largest, std::abs(elastic_[axis][i] + supports_.gravity[static_cast<int>(axis)] + applied_to(axis, i)));
  return largest;
}

// The class is instantiated in uniform_stepper.cpp, without these.
#define SAZARE_INSTANTIATE_SETTLING(D)                      \
  template void UniformStepper<D>::stand_still();           \
  template Real UniformStepper<D>::relax(const RelaxationRules&); \
  template Real UniformStepper<D>::kinetic_sum() const;     \
  template Real UniformStepper<D>::largest_unbalance() const;

SAZARE_INSTANTIATE_SETTLING(2)
SAZARE_INSTANTIATE_SETTLING(3)
#undef SAZARE_INSTANTIATE_SETTLING

}  // namespace sazare::particles
