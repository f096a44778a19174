#pragma once

/// A body's own step: the impulses it has gathered change its momenta, then it drifts to its next time, and its velocity
/// there is predicted.
///
/// The impulse of a link acts from the middle of the link's last interval to the middle of its next one, whatever the
/// levels of its bodies. So after a kick at T the momentum p holds what link l gives until e_l, and
///
///     p(t) = p + sum f_l (t - e_l)
///
/// with the forces f_l as last evaluated, or their means where nothing has been given yet (terms/slot.hpp): of second order in
/// time, for every body at any mix of levels. Dashpots and contacts take velocities from it; positions drift with p/m, which
/// is the leapfrog step.

#include "sazare/core/time.hpp"
#include "sazare/state/bodies.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::motion {

/// Removes what a body's locks take up.
template <int D>
void clear_locked(state::Impulse<D>& given, state::Locks locks);

/// Kicks a body that stands at its own time. What it is given, here and below, is about its centre, and so is what comes back.
template <int D>
state::MeanMotion<D> kick(state::Motion<D>& motion, const state::Inertia<D>& inertia, state::Locks locks,
                          state::Impulse<D> given);

/// Moves a body from its time to `due`, `seconds` later.
template <int D>
void drift(state::Motion<D>& motion, state::Inertia<D>& inertia, state::Locks locks, Tick due, Real seconds);

/// Predicts the velocity at `due`, where the body stands, after the kick at which this was given.
template <int D>
void predict(state::Motion<D>& motion, const state::Inertia<D>& inertia, state::Locks locks, state::Impulse<D> given);

/// Share of a predicted change of velocity that is left where a body is taken back to `now`. The velocity is taken to change
/// evenly: in the middle of the step it is the mean.
template <int D>
Real kept_change(const state::Motion<D>& motion, const Instant& now) {
  return 1 - 2 * static_cast<Real>(motion.due - now.tick) / static_cast<Real>(motion.due - motion.last_kick);
}

/// Takes a body that a link needs before its time back from `due` to `now`, which becomes its own time.
template <int D>
void drift_back(state::Motion<D>& motion, state::Inertia<D>& inertia, const Instant& now);

/// What turns an angular momentum into the spin, where a body has this rotation.
Matrix3 inverse_inertia(const Rotation<3>& rotation, const state::Inertia<3>& inertia, state::Locks locks);

/// Angular velocity [rad/s] that belongs to an angular momentum, where a body has this rotation.
inline Vector3 spin_of(const Rotation<3>& rotation, const state::Inertia<3>& inertia, state::Locks locks,
                       const Vector3& angular_momentum) {
  if (locks.rotation != 0) return inverse_inertia(rotation, inertia, locks) * angular_momentum;
  const Vector3 own = rotation.transpose() * angular_momentum;
  return rotation * inertia.inverse_moments.cwiseProduct(own);
}
inline Angular<2> spin_of(const Rotation<2>&, const state::Inertia<2>& inertia, state::Locks locks,
                          const Angular<2>& angular_momentum) {
  return Angular<2>(locks.rotation != 0 ? 0 : inertia.inverse_moments[0] * angular_momentum[0]);
}

/// Kinetic energy [J] of a velocity and an angular momentum, where a body has this rotation.
template <int D>
Real kinetic_energy(const Rotation<D>& rotation, const state::Inertia<D>& inertia, state::Locks locks, const Vector<D>& velocity,
                    const Angular<D>& angular_momentum) {
  Real turning;
  if constexpr (D == 3) {
    turning = locks.rotation == 0 ? (rotation.transpose() * angular_momentum).cwiseAbs2().dot(inertia.inverse_moments)
                                  : angular_momentum.dot(spin_of(rotation, inertia, locks, angular_momentum));
  } else {
    turning = angular_momentum.dot(spin_of(rotation, inertia, locks, angular_momentum));
  }
  return 0.5 * (inertia.mass * velocity.squaredNorm() + turning);
}

}  // namespace sazare::motion
