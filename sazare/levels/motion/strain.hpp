#pragma once

/// The step of a body's strain (state/strain.hpp): it is kicked, drifts and is predicted with the body, as its place is
/// (kick.hpp).

#include "sazare/state/bodies.hpp"

namespace sazare::motion {

/// Kicks the strain of a body that has just been kicked and has drifted to its next time. Returns the mean of its rates before
/// and after the kick: the impulse times it is the work done.
Vector6 step(state::Bodies<3>& bodies, Index body, state::StrainImpulse given, Real tick_seconds);

/// Takes the strain of a body back to `now`, before its motion is.
void drift_strain_back(state::Bodies<3>& bodies, Index body, const Instant& now);

/// The strain of a body at an instant, from what links have given to it until then.
state::StrainNow strain_now(const state::Bodies<3>& bodies, Index body, const Instant& now, state::StrainImpulse given);

/// What of a force on the strain of a body moves it: a rigid body has none, and locks take up their part [N m].
Vector6 free_force(const state::Bodies<3>& bodies, Index body, const Vector6& force);

/// Kinetic energy of a rate [J].
inline Real strain_energy(const state::Strain& body, const Vector6& rate) {
  return body.inverse_inertia > 0 ? 0.5 / body.inverse_inertia * rate.squaredNorm() : 0;
}

}  // namespace sazare::motion
