#pragma once

/// A link's own place for the force it has on its bodies.
///
/// A link writes its slot when it is evaluated; both its bodies are kicked at that tick. A body's gather reads all of its
/// slots: those written at that tick give their impulses, and all of them tell what pulls at the body now, from which its
/// velocity at its next time is predicted (see motion/kick.hpp).

#include <array>

#include "sazare/core/links.hpp"
#include "sazare/state/bodies.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::terms {

using state::Impulse;
using state::MeanMotion;

/// Action and reaction: force and moment on the second body, minus them those on the first. The moment is about the pole of
/// the bodies (state/bodies.hpp), one point for all of them: so it is the same for both, whatever their places, and the
/// angular momentum is kept as exactly as the linear one.
template <int D, class Number = Real>
struct PairForce {
  // No gaps, neither in the plane nor in single precision.
  using Force = Eigen::Matrix<Number, D, 1, Eigen::DontAlign>;
  using Moment = Eigen::Matrix<Number, angular_dimension<D>, 1, Eigen::DontAlign>;

  Force linear = Force::Zero();    ///< [N]
  Moment moment = Moment::Zero();  ///< [N m]

  /// Power on the second body where it moves so, minus that on the first where that does [W].
  Real power(const MeanMotion<D>& mean) const { return product(linear, mean.velocity) + product(moment, mean.spin); }

  template <class Other>
  PairForce<D, Other> as() const {
    return {linear.template cast<Other>(), moment.template cast<Other>()};
  }

  PairForce& operator+=(const PairForce& other) {
    linear += other.linear;
    moment += other.moment;
    return *this;
  }

  /// Adds a force on the second body at a point, given from the pole.
  void add_at(const Vector<D>& point, const Vector<D>& force) {
    linear += force;
    moment += sazare::moment(point, force);
  }

private:
  /// Number by number: vectors of converted ones would wait for one another in memory.
  template <class Any, class Vector>
  static Real product(const Any& a, const Vector& b) {
    Real sum = 0;
    for (int i = 0; i < b.size(); ++i) sum += static_cast<Real>(a[i]) * b[i];
    return sum;
  }
};

/// `Parts` counts the parts of the force whose work is summed apart (dashpot, friction); without any, that of the whole force is
/// (a load). The order of the members is that in which kernels write them. Impulses come from the total alone. What only serves
/// to sum work or to predict velocities is kept in single precision: kicks read every slot of a body. Where there is one part or
/// none, a slot in space takes two cache lines.
template <int D, int Parts>
struct alignas(64) Slot {
  PairForce<D> total;
  Real acting = 0;               ///< time for which the force was given at the last evaluation [s]
  Real ahead = 0;                ///< how much of the time given until then lies after that evaluation [s]
  Real evaluated = -1;           ///< tick of the last evaluation; a double, for gathers, and exact far beyond the longest run
  PairForce<D, float> previous;  ///< total at the evaluation before; at the first one that of itself
  std::array<PairForce<D, float>, Parts> part;
};

/// Writes what an evaluation has found. Velocities are predicted by the mean of a link's last two forces: a dashpot whose
/// velocity is predicted by the last force alone is stable up to 1 / c, by this mean up to 2 / c, and both are of second order.
template <int D, int Parts>
void write(Slot<D, Parts>& slot, const Instant& now, const Due& due, const PairForce<D>& total,
           const std::array<PairForce<D>, Parts>& part) {
  slot.previous = (slot.evaluated >= 0 ? slot.total : total).template as<float>();
  slot.total = total;
  slot.acting = due.acting;
  slot.ahead = due.ahead;
  slot.evaluated = static_cast<Real>(now.tick);
  for (std::size_t p = 0; p < Parts; ++p) slot.part[p] = part[p].template as<float>();
}

}  // namespace sazare::terms
