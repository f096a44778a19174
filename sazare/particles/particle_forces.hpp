#pragma once

#include <span>

#include "sazare/particles/particle_supports.hpp"
#include "sazare/state/particles.hpp"

namespace sazare::particles {

/// Forces between particles that follow from where they are and how they are turned.
template <int D>
class ParticleForces {
public:
  virtual ~ParticleForces() = default;

  /// Accelerations of all particles by these forces [m/s2], [rad/s2].
  virtual void evaluate(const state::Particles<D>& particles, state::FreedomColumns<D>& acceleration) = 0;

  /// Adds what part of the last accelerations has no Rayleigh damping, times a factor: that of contacts with dashpots of their
  /// own, whose forces would else be damped by how fast they change.
  virtual void add_undamped(Real /*factor*/, state::FreedomColumns<D>& /*acceleration*/) const {}

  /// What stands beside the particles and moves by itself begins, before their first evaluation, and goes a step ahead of each of
  /// theirs, while no equilibrium is sought.
  virtual void begin() {}
  virtual void go_ahead() {}
  /// Tells dashpots beside columns how these move at the time of the last evaluation.
  virtual void move_beyond(std::span<Dashpot> /*dashpots*/) const {}

  /// Energy stored in them [J; J/m in 2-D].
  virtual Real energy(const state::Particles<D>& particles) = 0;

  /// Columns of what they remember.
  virtual void columns(Archive& archive) = 0;
};

}  // namespace sazare::particles
