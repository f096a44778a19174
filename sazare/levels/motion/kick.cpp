#include "sazare/levels/motion/kick.hpp"

#include <cmath>

namespace sazare::motion {

namespace {

template <int N>
void clear_axes(Vector<N>& vector, std::uint8_t locked) {
  for (int axis = 0; axis < N; ++axis)
    if (locked >> axis & 1) vector[axis] = 0;
}

void rotate(state::Motion<3>& motion, state::Inertia<3>& inertia, Real seconds) {
  const Vector3 half = 0.5 * seconds * motion.spin;
  const Quaternion& q = inertia.orientation;
  const Vector3 v = q.vec();
  Quaternion turned;
  turned.w() = q.w() - half.dot(v);
  turned.vec() = v + q.w() * half + half.cross(v);
  turned.coeffs() *= 1 / std::sqrt(turned.squaredNorm());
  inertia.orientation = turned;
  motion.rotation = turned.toRotationMatrix();
}

void rotate(state::Motion<2>& motion, state::Inertia<2>& inertia, Real seconds) {
  inertia.angle += motion.spin[0] * seconds;
  const Real c = std::cos(inertia.angle), s = std::sin(inertia.angle);
  motion.rotation << c, -s, s, c;
}

/// Spin in the middle of the coming drift, while the angular momentum stays: d(spin)/dt = I^-1 (L x spin).
Vector3 spin_midway(const Matrix3& inverse, const Vector3& angular_momentum, const Vector3& spin, Real half_step) {
  return spin + half_step * (inverse * angular_momentum.cross(spin));
}

}  // namespace

/// Locked axes are taken out of the tensor itself (not of its inverse): the body then answers as if its free axes were all there
/// is.
Matrix3 inverse_inertia(const Rotation<3>& rotation, const state::Inertia<3>& inertia, state::Locks locks) {
  const Matrix3 scaled = rotation * inertia.inverse_moments.asDiagonal();
  const Matrix3 inverse = scaled * rotation.transpose();
  if (locks.rotation == 0) return inverse;
  Matrix3 tensor = inverse.inverse();
  for (int axis = 0; axis < 3; ++axis)
    if (locks.rotation >> axis & 1) {
      tensor.row(axis).setZero();
      tensor.col(axis).setZero();
      tensor(axis, axis) = 1;
    }
  Matrix3 free = tensor.inverse();
  for (int axis = 0; axis < 3; ++axis)
    if (locks.rotation >> axis & 1) free(axis, axis) = 0;
  return free;
}

template <int D>
void clear_locked(state::Impulse<D>& given, state::Locks locks) {
  if (!locks.any()) return;
  for (Vector<D>* const each : {&given.linear, &given.linear_lead}) clear_axes<D>(*each, locks.translation);
  for (Angular<D>* const each : {&given.angular, &given.angular_lead})
    clear_axes<angular_dimension<D>>(*each, locks.rotation);
}

template <int D>
state::MeanMotion<D> kick(state::Motion<D>& motion, const state::Inertia<D>& inertia, state::Locks locks,
                          state::Impulse<D> given) {
  clear_locked(given, locks);
  state::MeanMotion<D> mean;
  const Vector<D> gained = (1 / inertia.mass) * given.linear;
  mean.velocity = motion.velocity + 0.5 * gained;
  motion.velocity += gained;
  const Angular<D> before = motion.angular_momentum;
  motion.angular_momentum += given.angular;
  mean.spin = spin_of(motion.rotation, inertia, locks, before + 0.5 * given.angular);
  return mean;
}

template <int D>
void predict(state::Motion<D>& motion, const state::Inertia<D>& inertia, state::Locks locks, state::Impulse<D> given) {
  clear_locked(given, locks);
  motion.predicted_velocity = motion.velocity + (1 / inertia.mass) * given.linear_lead;
  motion.predicted_spin = spin_of(motion.rotation, inertia, locks, motion.angular_momentum + given.angular_lead);
}

template <>
void drift<3>(state::Motion<3>& motion, state::Inertia<3>& inertia, state::Locks locks, Tick due, Real seconds) {
  motion.position += seconds * motion.velocity;
  const Matrix3 inverse = inverse_inertia(motion.rotation, inertia, locks);
  const Vector3 spin = inverse * motion.angular_momentum;
  motion.spin = spin_midway(inverse, motion.angular_momentum, spin, 0.5 * seconds);
  rotate(motion, inertia, seconds);
  motion.last_kick = motion.due;
  motion.due = due;
}

template <>
void drift<2>(state::Motion<2>& motion, state::Inertia<2>& inertia, state::Locks locks, Tick due, Real seconds) {
  motion.position += seconds * motion.velocity;
  motion.spin = spin_of(motion.rotation, inertia, locks, motion.angular_momentum);
  rotate(motion, inertia, seconds);
  motion.last_kick = motion.due;
  motion.due = due;
}

template <int D>
void drift_back(state::Motion<D>& motion, state::Inertia<D>& inertia, const Instant& now) {
  const Real seconds = now.seconds_since(motion.due);
  motion.position += seconds * motion.velocity;
  rotate(motion, inertia, seconds);
  const Real kept = kept_change(motion, now);
  motion.predicted_velocity = motion.velocity + kept * (motion.predicted_velocity - motion.velocity);
  motion.predicted_spin = motion.spin + kept * (motion.predicted_spin - motion.spin);
  motion.due = now.tick;
}

template void clear_locked(state::Impulse<2>&, state::Locks);
template void clear_locked(state::Impulse<3>&, state::Locks);
template void drift_back(state::Motion<2>&, state::Inertia<2>&, const Instant&);
template void drift_back(state::Motion<3>&, state::Inertia<3>&, const Instant&);
template state::MeanMotion<2> kick(state::Motion<2>&, const state::Inertia<2>&, state::Locks, state::Impulse<2>);
template state::MeanMotion<3> kick(state::Motion<3>&, const state::Inertia<3>&, state::Locks, state::Impulse<3>);
template void predict(state::Motion<2>&, const state::Inertia<2>&, state::Locks, state::Impulse<2>);
template void predict(state::Motion<3>&, const state::Inertia<3>&, state::Locks, state::Impulse<3>);

}  // namespace sazare::motion
