#include "sazare/methods/mps/free_field.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace sazare::methods::mps {

template <int D>
FreeFieldForces<D>::FreeFieldForces(std::unique_ptr<particles::ParticleForces<D>> ground, SideGround<D> beside)
    : ground_(std::move(ground)), failing_(dynamic_cast<const FailingForces<D>*>(ground_.get())), beside_(std::move(beside)) {
  for (const SideCopy<D>& copy : beside_.copies)
    for (state::Column& column : differences_.emplace_back()) column.assign(copy.particles.padded(), 0);
  before_ = differences_;
}

template <int D>
Real FreeFieldForces<D>::relax(std::size_t column, const particles::RelaxationRules& rules) {
  particles::RelaxationRules with_copies = rules;
  with_copies.goes_on = [&](std::int64_t step, Real left) {  // so that the copies yield as the column does
    for (std::size_t i = 0; i < beside_.copies.size(); ++i)
      if (beside_.copies[i].column == column) follow(i);
    return rules.goes_on(step, left);
  };
  return beside_.columns[column]->relax(with_copies);
}

template <int D>
void FreeFieldForces<D>::begin() {
  for (const auto& column : beside_.columns) column->start();
  for (std::size_t i = 0; i < beside_.copies.size(); ++i) follow(i);
  work_ = 0;
  counts_ = false;
}

template <int D>
void FreeFieldForces<D>::go_ahead() {
  for (const auto& column : beside_.columns) column->advance();
  for (std::size_t i = 0; i < beside_.copies.size(); ++i) follow(i);
  counts_ = true;
}

/// Moves a copy where its column is now.
template <int D>
void FreeFieldForces<D>::follow(std::size_t number) {
  SideCopy<D>& copy = beside_.copies[number];
  const particles::UniformStepper<D>& column = *beside_.columns[copy.column];
  const state::Particles<D>& leader = column.particles();
  const auto take = [&](auto& own, const auto& others) {
    for (std::size_t n = 0; n < own.size(); ++n)
      for (std::size_t i = 0; i < copy.particles.size(); ++i) own[n][i] = others[n][at(copy.follows[i])];
  };
  take(copy.particles.displacement, leader.displacement);
  take(copy.particles.rotation, leader.rotation);
  take(copy.particles.velocity, leader.velocity);
  if constexpr (D == 2)
    for (std::size_t i = 0; i < copy.particles.size(); ++i) copy.particles.angle[i] = leader.angle[at(copy.follows[i])];
  state::FreedomColumns<D>& difference = differences_[number];
  copy.forces->evaluate(copy.particles, difference);
  for (std::size_t freedom = 0; freedom < difference.size(); ++freedom)
    for (std::size_t i = 0; i < copy.particles.size(); ++i)
      difference[freedom][i] = column.acceleration_by_forces()[freedom][at(copy.follows[i])] - difference[freedom][i];
}

template <int D>
void FreeFieldForces<D>::move_beyond(std::span<particles::Dashpot> dashpots) const {
  std::vector<state::FreedomColumns<D>> velocities;
  for (const auto& column : beside_.columns) velocities.push_back(column->velocity());
  for (const SideDashpot& one : beside_.dashpots) {
    particles::Dashpot& dashpot = dashpots[one.dashpot];
    dashpot.beyond = velocities[one.column][static_cast<std::size_t>(dashpot.freedom)][at(one.particle)];
  }
}

template <int D>
template <class Visit>
void FreeFieldForces<D>::each_pair(Visit&& visit) const {
  for (std::size_t copy = 0; copy < beside_.copies.size(); ++copy)
    for (const auto& pair : beside_.copies[copy].pairs) visit(copy, pair);
}

template <int D>
void FreeFieldForces<D>::evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) {
  ground_->evaluate(particles, acceleration);
  auto now = given(particles);
  if (counts_) add_work(particles, now);
  counts_ = false;
  each_pair([&](std::size_t copy, const auto& pair) {
    for (std::size_t freedom = 0; freedom < acceleration.size(); ++freedom)
      acceleration[freedom][at(pair.of_ground)] += now[copy][freedom][at(pair.of_copy)];
  });
  before_ = std::move(now);
}

/// What the ground gets of the differences.
template <int D>
std::vector<state::FreedomColumns<D>> FreeFieldForces<D>::given(const state::Particles<D>& particles) const {
  auto now = differences_;
  if (failing_ != nullptr)
    each_pair([&](std::size_t copy, const auto& pair) {
      if (const Real part = share(particles, beside_.copies[copy], pair); part < 1)
        for (auto& column : now[copy]) column[at(pair.of_copy)] *= part;
    });
  return now;
}

/// Less than 1 for a broken particle that has gone from its row of the column.
template <int D>
Real FreeFieldForces<D>::share(const state::Particles<D>& particles, const SideCopy<D>& copy,
                               const typename SideCopy<D>::Pair& pair) const {
  constexpr Real whole = 0.25, none = 0.75;  // of the spacing
  if (failing_->broken_fraction(pair.of_ground) < 1) return 1;
  Real square = 0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const Real gone = particles.displacement[axis][at(pair.of_ground)] - copy.particles.displacement[axis][at(pair.of_copy)];
    square += gone * gone;
  }
  return std::clamp((none - std::sqrt(square) / particles.spacing) / (none - whole), Real{0}, Real{1});
}

/// The mean of the forces at both ends of the step times the way, as the stepper counts work.
template <int D>
void FreeFieldForces<D>::add_work(const state::Particles<D>& particles, const std::vector<state::FreedomColumns<D>>& now) {
  const Real step = beside_.columns.front()->rules().step;
  each_pair([&](std::size_t copy, const auto& pair) {
    for (std::size_t freedom = 0; freedom < particles.velocity.size(); ++freedom) {
      const std::size_t own = at(pair.of_copy), ground = at(pair.of_ground);
      const Real mean = 0.5 * (before_[copy][freedom][own] + now[copy][freedom][own]);
      work_ += mean * step * particles.velocity[freedom][ground] / particles.inverse_inertia_of(freedom)[ground];
    }
  });
}

template <int D>
void FreeFieldForces<D>::columns(Archive& archive) {
  archive.folder("ground", [&] { ground_->columns(archive); });
  for (std::size_t i = 0; i < beside_.columns.size(); ++i)
    archive.folder("column" + std::to_string(i), [&] { beside_.columns[i]->columns(archive); });
  for (std::size_t i = 0; i < beside_.copies.size(); ++i)
    archive.folder("copy" + std::to_string(i), [&] {
      beside_.copies[i].forces->columns(archive);
      for (std::size_t freedom = 0; freedom < before_[i].size(); ++freedom)
        archive("difference" + std::to_string(freedom), before_[i][freedom]);
    });
  archive("side_work", work_);
  if (archive.reading()) differences_ = before_;
}

template class FreeFieldForces<2>;
template class FreeFieldForces<3>;

}  // namespace sazare::methods::mps
