#pragma once

/// A body's own step: the impulses it has gathered change its momenta, then it drifts to its next time.
///
/// Impulses that were evaluated before the kick count as given at their own moments t_k: the position moves by
/// X/m, X = sum J_k (T - t_k), and the angular momentum by
///
///     dL = sum of angular impulses - (X/m) x sum J_k
///
/// With arms taken about the drifted position at t_k this leaves the total angular momentum unchanged exactly: the orbital
/// part changes by X x v + x x S + X x S/m (S = sum J_k, x the position before the shift), the angular impulses hold
/// sum p_k x J_k - x x S + v x X, and what remains is the last term above.

#include "sazare/core/time.hpp"
#include "sazare/state/bodies.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::motion {

/// Removes what a body's locks take up.
template <int D>
void clear_locked(state::Impulse<D>& given, state::Locks locks);

/// Kicks a body that stands at its own time. Position and rotation are shifted, momenta changed; `due` stays.
template <int D>
state::MeanMotion<D> kick(state::Motion<D>& motion, state::Inertia<D>& inertia, state::Locks locks, state::Impulse<D> given);

/// Moves a body from its time to `due`, `seconds` later.
template <int D>
void drift(state::Motion<D>& motion, state::Inertia<D>& inertia, state::Locks locks, Tick due, Real seconds);

/// Takes a body that is woken before its time back from `due` to `now`, which becomes its own time.
template <int D>
void drift_back(state::Motion<D>& motion, state::Inertia<D>& inertia, const Moment& now);

/// Angular velocity [rad/s] that belongs to an angular momentum in the body's present place.
Vector3 spin_of(const state::Motion<3>& motion, const state::Inertia<3>& inertia, state::Locks locks,
                const Vector3& angular_momentum);
Angular<2> spin_of(const state::Motion<2>& motion, const state::Inertia<2>& inertia, state::Locks locks,
                   const Angular<2>& angular_momentum);

/// Kinetic energy [J] of a velocity and an angular momentum.
template <int D>
Real kinetic_energy(const state::Motion<D>& motion, const state::Inertia<D>& inertia, state::Locks locks,
                    const Vector<D>& velocity, const Angular<D>& angular_momentum) {
  return 0.5 * (inertia.mass * velocity.squaredNorm() +
                angular_momentum.dot(spin_of(motion, inertia, locks, angular_momentum)));
}

}  // namespace sazare::motion
