#pragma once

/// What passes between forces and bodies.

#include "sazare/core/rotation.hpp"

namespace sazare::state {

/// What one body receives at a kick, and what its momentum will have gained by its next time: the sums over its links of
///
///     impulse given since its last kick
///     f (until_next - e)   where the force f, as last evaluated, has been given until e beyond that time: it is taken back
///     F (until_next - e)   where nothing has been given yet after e: the mean force F of the link, see terms/slot.hpp
template <int D>
struct alignas(64) Impulse {
  Vector<D> linear = Vector<D>::Zero();                   ///< [N s]
  Angular<D> angular = Angular<D>::Zero();                ///< about the pole of the bodies [N m s]
  Real until_next = 0;                                    ///< asked for: time from now to the body's next one [s]
  alignas(64) Vector<D> linear_lead = Vector<D>::Zero();  ///< [N s]; each pair begins a cache line, for gathers
  Angular<D> angular_lead = Angular<D>::Zero();           ///< about the pole too [N m s]

  /// The impulse about another point, at this distance from the point of reference.
  Impulse about(const Vector<D>& point) const {
    Impulse moved = *this;
    moved.angular -= moment(point, linear);
    moved.angular_lead -= moment(point, linear_lead);
    return moved;
  }
};

/// Mean of a body's motion before and after a kick: impulse times this is exactly the work done, where both are about the same
/// point.
template <int D>
struct alignas(64) MeanMotion {
  Vector<D> velocity;  ///< of what would be the body's point at the pole [m/s]
  Angular<D> spin;     ///< [rad/s]

  /// The mean motion of another point, at this distance from the point of reference.
  MeanMotion at(const Vector<D>& point) const { return {velocity + turned(spin, point), spin}; }
};

}  // namespace sazare::state
