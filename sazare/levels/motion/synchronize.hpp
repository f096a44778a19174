#pragma once

/// Bodies at a base step, for snapshots and the energy balance: nothing here changes them. All spans of a call have one length;
/// they are those of the bodies from `first` on, which stand side by side.

#include <span>

#include "sazare/state/bodies.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::motion {

/// Where and how fast bodies are at an instant.
template <int D, class VectorNow, class AngularNow>
struct MotionNow {
  std::span<const state::Pose<D>> pose;
  std::span<VectorNow> velocity;           ///< [m/s]
  std::span<AngularNow> angular_momentum;  ///< [kg m2/s]
};
template <int D>
using MotionSeen = MotionNow<D, const Vector<D>, const Angular<D>>;
template <int D>
using MotionFound = MotionNow<D, Vector<D>, Angular<D>>;

/// Finds velocities and momenta at an instant from those after the last kicks and from what links have given until then.
template <int D>
void find_momenta(const state::Bodies<D>& bodies, std::size_t first, std::span<const state::Impulse<D>> given,
                  const MotionFound<D>& now);

/// Kinetic energies [J], and the means of the motion after the last kicks and now.
template <int D>
void find_energies(const state::Bodies<D>& bodies, std::size_t first, const MotionSeen<D>& now, std::span<Real> energy,
                   std::span<state::MeanMotion<D>> ahead);

}  // namespace sazare::motion
