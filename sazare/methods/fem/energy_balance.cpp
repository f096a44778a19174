/// The energy balance of FemStepper: work by cause, and energies.

#include <algorithm>
#include <cmath>
#include <limits>

#include "sazare/methods/fem/free_field.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/stepper.hpp"

namespace sazare::methods::fem {

using methods::fem::add, methods::fem::dot, methods::fem::number, methods::fem::product;
using methods::fem::NodalColumn, methods::fem::Support;

namespace {

/// Work of a force, with its mean over the step.
Real mean_work(const NodalColumn& before, const NodalColumn& after, const NodalColumn& moved) {
  Real sum = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) sum += 0.5 * (before[i] + after[i]) * moved[i];
  return sum;
}

}  // namespace

/// Whether nothing has been carried so far.
template <int D>
bool FemStepper<D>::is_unloaded() const {
  return std::ranges::all_of(state_.internal, [](Real force) { return force == 0; });
}

/// Work of a step, each force with its mean over it. The first step of a static run brings its loads to bear, from nothing to what
/// they are at its end, as does any step what has been applied from outside since the last one.
template <int D>
void FemStepper<D>::add_work(const Trial& trial, const NodalColumn& balance, const Span& span) {
  NodalColumn moved = trial.displacement;
  add(moved, -1, state_.displacement);
  FemWork& work = state_.work;
  if (!body_->is_linear()) {
    const auto taken = body_->energies(state_.displacement, trial.displacement, state_.memory, trial.memory);
    work.plastic += taken.plastic;
    work.friction += taken.friction;
    work.members += taken.members;
  }
  if (stage_ == Stage::relaxing) return;
  const bool brings = rules_.statics && span.from == 0;
  work.gravity += (brings && is_unloaded() ? 0.5 : 1) * dot(weight_, moved);
  for (const auto& load : supports_.loads)
    work.loads += 0.5 * ((brings ? 0 : load.share(span.from)) + load.share(span.to)) * dot(load.force, moved);
  work.water += (brings && is_unloaded() ? 0.5 : 1) * dot(pore_, moved);
  for (const auto& water : supports_.waters)
    work.water += 0.5 * ((brings && is_unloaded() ? 0 : water.pressure.share(span.from)) + water.pressure.share(span.to)) *
                  dot(water.pressure.force, moved);
  work.loads += rules_.statics ? mean_work(state_.carried, state_.applied, moved) : dot(state_.applied, moved);
  state_.carried = state_.applied;
  work.boundary += dot(reaction_, moved);
  NodalColumn before = state_.balance, after = balance;
  if (inertia()) {
    add_work_of_damping(trial, span, moved);
    work.radiation += mean_work(product(viscous_, state_.velocity), product(viscous_, trial.velocity), moved);
    work.waves += mean_work(incoming(span.from), incoming(span.to), moved);
    if (!free_field_->is_empty()) add_work_of_sides(trial, span, moved);
    mass_.multiply(state_.acceleration, 1, before);
    mass_.multiply(trial.acceleration, 1, after);
  }
  if (pore_matrices_) {
    const auto& seepage = pore_matrices_->seepage;
    work.seepage += mean_work(product(seepage, state_.velocity), product(seepage, trial.velocity), moved);
  }
  for (const Support& support : supports_.held) {
    if (support.motion == Support::no_motion) continue;
    const std::size_t i = number<D>(support.node, support.axis);
    work.boundary += 0.5 * (before[i] + after[i]) * moved[i];
  }
}

/// What damping does on the motion of the base is the work of the base.
template <int D>
void FemStepper<D>::add_work_of_damping(const Trial& trial, const Span& span, const NodalColumn& moved) {
  const auto force = [&](NodalColumn velocity, Real when) {
    add(velocity, -1, body_->at_all_nodes(base_motion(when, &laws::MotionState::velocity)));
    return product(rayleigh_, velocity);
  };
  const NodalColumn before = force(state_.velocity, span.from), after = force(trial.velocity, span.to);
  const Vector<D> way =
      base_motion(span.to, &laws::MotionState::displacement) - base_motion(span.from, &laws::MotionState::displacement);
  const Real all = mean_work(before, after, moved), on_base = mean_work(before, after, body_->at_all_nodes(way));
  state_.work.damping += all - on_base;
  state_.work.boundary -= on_base;
}

/// Dashpots dissipate by the velocity of the body relative to the columns; all else that sides do is work of the columns.
template <int D>
void FemStepper<D>::add_work_of_sides(const Trial& trial, const Span& span, const NodalColumn& moved) {
  const auto braking = [&](NodalColumn velocity, Real when, Real share_of_column) {
    add(velocity, -share_of_column, at_sides(when, &SideMotion::velocity));
    return product(free_field_->impedance(), velocity);
  };
  NodalColumn relative = moved;
  add(relative, -1, at_sides(span.to, &SideMotion::displacement));
  add(relative, 1, at_sides(span.from, &SideMotion::displacement));
  const Real dissipated = mean_work(braking(state_.velocity, span.from, 1), braking(trial.velocity, span.to, 1), relative);
  const Real in_all = mean_work(at_sides(span.from, &SideMotion::force), at_sides(span.to, &SideMotion::force), moved) -
                      mean_work(braking(state_.velocity, span.from, 0), braking(trial.velocity, span.to, 0), moved);
  state_.work.radiation += dissipated;
  state_.work.sides += in_all + dissipated;
}

template <int D>
Real FemStepper<D>::kinetic_energy() const {
  return 0.5 * dot(state_.velocity, product(mass_, state_.velocity)) - elastic_energy_of_water();
}

template <int D>
Real FemStepper<D>::elastic_energy_of_water() const {
  return pore_matrices_ ? 0.5 * dot(state_.velocity, product(pore_matrices_->storage, state_.velocity)) : 0;
}

template <int D>
Real FemStepper<D>::kinetic_energy_of_water() const {
  Real sum = 0;
  for (const auto& water : supports_.waters)
    for (const auto& face : water.moving) {
      Eigen::VectorXd velocity(face.mass.rows());
      for (Eigen::Index i = 0; i < velocity.size(); ++i)
        velocity[i] = state_.velocity[number<D>(face.nodes[static_cast<std::size_t>(i / D)], static_cast<int>(i % D))];
      sum += 0.5 * velocity.dot(face.mass * velocity);
    }
  return sum;
}

template <int D>
Real FemStepper<D>::elastic_energy() const {
  return body_->energies(state_.displacement, state_.displacement, state_.memory, state_.memory).elastic - elastic_at_start_ +
         elastic_energy_of_water();
}

template <int D>
Real FemStepper<D>::energy_residual() const {
  const FemWork& work = state_.work;
  const Real done = work.gravity + work.loads + work.water + work.boundary + work.waves + work.sides;
  const Real kinetic = rules_.statics ? 0 : kinetic_energy();
  return done - kinetic - elastic_energy() - work.damping - work.radiation - work.plastic - work.friction - work.seepage -
         work.members;
}

/// Errors of the steps have either sign and add up as the root of their number.
template <int D>
Real FemStepper<D>::round_off_energy() const {
  NodalColumn far = state_.displacement;
  for (Real& way : far) way = std::abs(way);
  const auto times = static_cast<Real>(std::max<std::int64_t>(state_.steps, 1));
  return std::sqrt(times) * std::numeric_limits<Real>::epsilon() * dot(far, state_.tangent.magnitude_of_product(far));
}

// The class is instantiated in stepper.cpp, without these.
#define SAZARE_INSTANTIATE(D)                                                                      \
  template bool FemStepper<D>::is_unloaded() const;                                                \
  template void FemStepper<D>::add_work(const Trial&, const NodalColumn&, const Span&);            \
  template void FemStepper<D>::add_work_of_damping(const Trial&, const Span&, const NodalColumn&); \
  template void FemStepper<D>::add_work_of_sides(const Trial&, const Span&, const NodalColumn&);   \
  template Real FemStepper<D>::kinetic_energy() const;                                             \
  template Real FemStepper<D>::elastic_energy_of_water() const;                                    \
  template Real FemStepper<D>::kinetic_energy_of_water() const;                                    \
  template Real FemStepper<D>::elastic_energy() const;                                             \
  template Real FemStepper<D>::energy_residual() const;                                            \
  template Real FemStepper<D>::round_off_energy() const;

SAZARE_INSTANTIATE(2)
SAZARE_INSTANTIATE(3)
#undef SAZARE_INSTANTIATE

}  // namespace sazare::methods::fem
