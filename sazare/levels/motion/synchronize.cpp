#include "sazare/levels/motion/synchronize.hpp"

#include "sazare/core/vector_of.hpp"
#include "sazare/levels/motion/kick.hpp"

namespace sazare::motion {

namespace {

/// What a body's angular momentum gains about its centre, which is given from the pole; rounded as in the kernels that kick.
Angular<3> angular_gain(const state::Impulse<3>& given, const Vector3& centre) {
  return add_cross(given.linear_lead, centre, given.angular_lead);
}
Angular<2> angular_gain(const state::Impulse<2>& given, const Vector<2>& centre) { return given.about(centre).angular_lead; }

template <int D>
void find_momentum(const state::Bodies<D>& bodies, std::size_t body, state::Impulse<D> given, const state::Pose<D>& pose,
                   Vector<D>& velocity, Angular<D>& angular_momentum) {
  const auto& motion = bodies.motion[body];
  given.angular_lead = angular_gain(given, pose.position - bodies.pole);
  clear_locked(given, bodies.locks[body]);
  velocity = motion.velocity + 1 / bodies.inertia[body].mass * given.linear_lead;
  angular_momentum = motion.angular_momentum + given.angular_lead;
}

template <int D>
void find_energy(const state::Bodies<D>& bodies, std::size_t body, const state::Pose<D>& pose, const Vector<D>& velocity,
                 const Angular<D>& angular_momentum, Real& energy, state::MeanMotion<D>& ahead) {
  const auto& motion = bodies.motion[body];
  const auto& inertia = bodies.inertia[body];
  const state::Locks locks = bodies.locks[body];
  const Angular<D> mean_momentum = 0.5 * (motion.angular_momentum + angular_momentum);
  const state::MeanMotion<D> mean{0.5 * (motion.velocity + velocity), spin_of(pose.rotation, inertia, locks, mean_momentum)};
  ahead = mean.at(bodies.pole - pose.position);
  energy = kinetic_energy<D>(pose.rotation, inertia, locks, velocity, angular_momentum);
}

}  // namespace

template <int D>
void find_momenta(const state::Bodies<D>& bodies, std::size_t first, std::span<const state::Impulse<D>> given,
                  const MotionFound<D>& now) {
  for (std::size_t i = 0; i < given.size(); ++i)
    find_momentum(bodies, first + i, given[i], now.pose[i], now.velocity[i], now.angular_momentum[i]);
}

template <int D>
void find_energies(const state::Bodies<D>& bodies, std::size_t first, const MotionSeen<D>& now, std::span<Real> energy,
                   std::span<state::MeanMotion<D>> ahead) {
  for (std::size_t i = 0; i < energy.size(); ++i)
    find_energy(bodies, first + i, now.pose[i], now.velocity[i], now.angular_momentum[i], energy[i], ahead[i]);
}

template void find_momenta<2>(const state::Bodies<2>&, std::size_t, std::span<const state::Impulse<2>>, const MotionFound<2>&);
template void find_momenta<3>(const state::Bodies<3>&, std::size_t, std::span<const state::Impulse<3>>, const MotionFound<3>&);
template void find_energies<2>(const state::Bodies<2>&, std::size_t, const MotionSeen<2>&, std::span<Real>,
                               std::span<state::MeanMotion<2>>);
template void find_energies<3>(const state::Bodies<3>&, std::size_t, const MotionSeen<3>&, std::span<Real>,
                               std::span<state::MeanMotion<3>>);

}  // namespace sazare::motion
