#pragma once

/// What passes between forces and bodies.

#include "sazare/core/rotation.hpp"

namespace sazare::state {

/// What one body receives at a kick.
template <int D>
struct alignas(64) Impulse {
  Vector<D> linear = Vector<D>::Zero();     ///< [N s]
  Angular<D> angular = Angular<D>::Zero();  ///< about the centre of mass [N m s]
  Vector<D> shift = Vector<D>::Zero();      ///< sum of impulse x its lateness [N s2]
  Angular<D> twist = Angular<D>::Zero();    ///< sum of angular impulse x its lateness [N m s2]
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
  friend Wrench operator*(Real factor, const Wrench& wrench) {
    return {factor * wrench.linear, factor * wrench.angular};
  }
};

}  // namespace sazare::state
