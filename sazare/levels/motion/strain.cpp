#include "sazare/levels/motion/strain.hpp"

#include "sazare/levels/motion/kick.hpp"

namespace sazare::motion {

namespace {

/// Takes out of forces on a strain what would move points of the body along the axes of the world in which its translation is
/// locked.
Vector6 without_locked(const Vector6& numbers, const Matrix3& rotation, state::Locks locks) {
  Matrix3 world = rotation * tensor_of(numbers) * rotation.transpose();
  for (int axis = 0; axis < 3; ++axis)
    if (locks.translation >> axis & 1) {
      world.row(axis).setZero();
      world.col(axis).setZero();
    }
  return numbers_of(rotation.transpose() * world * rotation);
}

void clear_locked(const state::Bodies<3>& bodies, Index body, state::StrainImpulse& given) {
  const state::Locks locks = bodies.locks[at(body)];
  if (locks.translation == 0) return;
  for (Vector6* each : {&given.given, &given.lead}) *each = without_locked(*each, bodies.motion[at(body)].rotation, locks);
}

}  // namespace

Vector6 step(state::Bodies<3>& bodies, Index body, state::StrainImpulse given, Real tick_seconds) {
  const auto& motion = bodies.motion[at(body)];
  auto& strain = bodies.strain[at(body)];
  clear_locked(bodies, body, given);
  const Vector6 gained = strain.inverse_inertia * given.given, mean = strain.rate + 0.5 * gained;
  strain.rate += gained;
  strain.strain += static_cast<Real>(motion.due - motion.last_kick) * tick_seconds * strain.rate;
  strain.predicted_rate = strain.rate + strain.inverse_inertia * given.lead;
  return mean;
}

void drift_strain_back(state::Bodies<3>& bodies, Index body, const Instant& now) {
  const auto& motion = bodies.motion[at(body)];
  auto& strain = bodies.strain[at(body)];
  strain.strain += now.seconds_since(motion.due) * strain.rate;
  strain.predicted_rate = strain.rate + kept_change(motion, now) * (strain.predicted_rate - strain.rate);
}

Vector6 free_force(const state::Bodies<3>& bodies, Index body, const Vector6& force) {
  if (bodies.strain[at(body)].inverse_inertia == 0) return Vector6::Zero();
  return without_locked(force, bodies.motion[at(body)].rotation, bodies.locks[at(body)]);
}

state::StrainNow strain_now(const state::Bodies<3>& bodies, Index body, const Instant& now, state::StrainImpulse given) {
  const auto& motion = bodies.motion[at(body)];
  const auto& strain = bodies.strain[at(body)];
  clear_locked(bodies, body, given);
  state::StrainNow found;
  found.strain = strain.strain + (motion.due == now.tick ? 0 : now.seconds_since(motion.due)) * strain.rate;
  found.rate = strain.rate + strain.inverse_inertia * given.lead;
  found.ahead = 0.5 * (strain.rate + found.rate);
  return found;
}

}  // namespace sazare::motion
