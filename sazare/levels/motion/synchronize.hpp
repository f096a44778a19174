#pragma once

/// Bodies at a base step, for snapshots and the energy balance: nothing here changes them. All spans of a call have one length;
/// they are those of the bodies from `first` on, which stand side by side.

#include <span>

#include "sazare/state/bodies.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::motion {

/// Where and how fast bodies are at a moment.
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

/// Finds velocities and momenta at a moment from those after the last kicks and from what links have given until then.
void find_momenta(const state::Bodies<3>& bodies, std::size_t first, std::span<const state::Impulse<3>> given,
                  const MotionFound<3>& now);
void find_momenta(const state::Bodies<2>& bodies, std::size_t first, std::span<const state::Impulse<2>> given,
                  const MotionFound<2>& now);

/// Kinetic energies [J], and the means of the motion after the last kicks and now.
void find_energies(const state::Bodies<3>& bodies, std::size_t first, const MotionSeen<3>& now, std::span<Real> energy,
                   std::span<state::MeanMotion<3>> ahead);
void find_energies(const state::Bodies<2>& bodies, std::size_t first, const MotionSeen<2>& now, std::span<Real> energy,
                   std::span<state::MeanMotion<2>> ahead);

}  // namespace sazare::motion
