#pragma once

/// The largest stable step of a model, from its linearised operator, without a run.
///
/// With A = M^-1 K at rest, h the damping ratio of each particle and a2 from f1, f2, leapfrog and Verlet with the lagged damping
/// force of (A24) first fail in a motion that changes its sign at every step: r(k) = (-1)^k p. Put in,
///
///     p = (dt^2 + 2 dt a2 h)/4 A p,
///
/// so the limit is the dt at which the largest eigenvalue of (dt^2 + 2 dt a2 h)/4 A is 1. For one h in all particles it is the
/// positive root of w^2 dt^2 + 2 w^2 a2 h dt = 4, w^2 the largest eigenvalue of A. Damping in proportion to mass and viscous
/// boundaries act on the mean of two velocities, which such a motion does not have: they leave the limit as it is.
///
/// Euler's step is stable while |1 + s dt| <= 1 for both roots of s^2 + (a1 h + a2 h w^2) s + w^2 = 0, for every w. With the
/// damping force of the step before, b = a2 h and c = a1 h + b w^2, Jury's conditions for z (z - 1)^2 + dt a1 h z (z - 1) + dt b
/// w^2 (z - 1) + dt^2 w^2 z = 0 give dt < c/(w^2 (1 + b c)).

#include "sazare/laws/rayleigh_damping.hpp"
#include "sazare/methods/mps/link_table.hpp"
#include "sazare/particles/particle_supports.hpp"
#include "sazare/state/particles.hpp"

namespace sazare::methods::mps {

struct StableStep {
  Real verlet = 0;     ///< limit of Verlet and leapfrog [s]
  Real euler = 0;      ///< limit of Euler [s]; 0 without damping
  Real euler_lagged = 0;  ///< of Euler with the damping force of the step before [s]; 0 without damping
  Real frequency = 0;  ///< largest angular frequency of the undamped model [rad/s]
};

/// The limit with springs to the outside besides, none of which gives a particle more than `square` = k/m [1/s2] and which have
/// no damping of their own: (w^2 + square) dt^2 + 2 w^2 lag dt = 4, lag as the limit without them tells it. Of Euler nothing is
/// known.
StableStep with_outside_springs(const StableStep& without, Real square);

template <int D>
StableStep stable_step(const state::Particles<D>& particles, const LinkTable<D>& links,
                       const particles::ParticleSupports<D>& supports, const laws::RayleighDamping& damping);

extern template StableStep stable_step<2>(const state::Particles<2>&, const LinkTable<2>&, const particles::ParticleSupports<2>&,
                                          const laws::RayleighDamping&);
extern template StableStep stable_step<3>(const state::Particles<3>&, const LinkTable<3>&, const particles::ParticleSupports<3>&,
                                          const laws::RayleighDamping&);

}  // namespace sazare::methods::mps
