#pragma once

/// What passes between forces and bodies.

#include "sazare/core/rotation.hpp"

namespace sazare::state {

/// What one body receives at a kick, and what pulls at it then: the sums over its links of
///
///     impulse given since its last kick
///     force f as last evaluated
///     f x (end of the time for which it has been given - now), so that momentum - this is the momentum at now; less, for the
///     part of `until_next` that no force has been given for yet, the mean force of the link (see terms/slot.hpp) less f
template <int D>
struct alignas(64) Impulse {
  Vector<D> linear = Vector<D>::Zero();                    ///< [N s]
  Angular<D> angular = Angular<D>::Zero();                 ///< about the centre of mass [N m s]
  Real until_next = 0;                                     ///< asked for: time from now to the body's next one [s]
  alignas(64) Vector<D> force = Vector<D>::Zero();         ///< [N]; each pair begins a cache line, for gathers
  Angular<D> torque = Angular<D>::Zero();                  ///< about the centre of mass [N m]
  alignas(64) Vector<D> linear_ahead = Vector<D>::Zero();  ///< [N s]
  Angular<D> angular_ahead = Angular<D>::Zero();           ///< [N m s]
};

/// Mean of a body's motion before and after a kick: impulse times this is exactly the work done.
template <int D>
struct alignas(64) MeanMotion {
  Vector<D> velocity;
  Angular<D> spin;
};

/// A force, or an impulse, on one body and its moment about the centre of mass.
template <int D>
struct Wrench {
  Vector<D> linear = Vector<D>::Zero();
  Angular<D> angular = Angular<D>::Zero();

  Real power(const MeanMotion<D>& mean) const { return linear.dot(mean.velocity) + angular.dot(mean.spin); }

  Wrench& operator+=(const Wrench& other) {
    linear += other.linear;
    angular += other.angular;
    return *this;
  }
  friend Wrench operator*(Real factor, const Wrench& wrench) { return {factor * wrench.linear, factor * wrench.angular}; }
};

}  // namespace sazare::state
