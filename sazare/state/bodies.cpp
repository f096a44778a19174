#include "sazare/state/bodies.hpp"

#include <cmath>
#include <cstddef>

#include "sazare/core/vector_of.hpp"

namespace sazare::state {

Index add_body(Bodies<3>& bodies, Real mass, const Vector3& centre, const Vector3& principal_moments,
               const Quaternion& orientation, Real reach) {
  Motion<3> motion;
  motion.position = centre;
  motion.velocity.setZero();
  motion.predicted_velocity.setZero();
  motion.rotation = orientation.toRotationMatrix();
  motion.spin.setZero();
  motion.predicted_spin.setZero();
  motion.angular_momentum.setZero();
  bodies.motion.push_back(motion);
  bodies.inertia.push_back({orientation, principal_moments.cwiseInverse(), mass});
  bodies.reach.push_back(reach);
  bodies.locks.push_back({});
  bodies.start.push_back(centre);
  bodies.start_orientation.push_back(orientation);
  return bodies.size() - 1;
}

Index add_body(Bodies<2>& bodies, Real mass, const Vector<2>& centre, Real moment, Real reach) {
  Motion<2> motion;
  motion.position = centre;
  motion.velocity.setZero();
  motion.predicted_velocity.setZero();
  motion.rotation.setIdentity();
  motion.spin.setZero();
  motion.predicted_spin.setZero();
  motion.angular_momentum.setZero();
  bodies.motion.push_back(motion);
  bodies.inertia.push_back({0, Angular<2>(1 / moment), mass});
  bodies.reach.push_back(reach);
  bodies.locks.push_back({});
  bodies.start.push_back(centre);
  bodies.start_orientation.push_back(0);
  return bodies.size() - 1;
}

Vector3 middle(const Bodies<3>& bodies) {
  if (bodies.start.empty()) return Vector3::Zero();
  Vector3 low = bodies.start[0], high = low;
  for (const Vector3& centre : bodies.start) {
    low = low.cwiseMin(centre);
    high = high.cwiseMax(centre);
  }
  return 0.5 * (low + high);
}

Rotation<3> turn(const Vector3& spin, Real seconds) {
  const Vector3 half = 0.5 * seconds * spin;
  const auto column = rotation_of<Real>(2 / (1 + dot(half, half)), half[0], half[1], half[2], 1);
  Rotation<3> rotation;
  for (int i = 0; i < 3; ++i) rotation.col(i) = column[static_cast<std::size_t>(i)];
  return rotation;
}

Rotation<2> turn(const Angular<2>& spin, Real seconds) {
  const Real angle = seconds * spin[0];
  Rotation<2> rotation;
  rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return rotation;
}

Pose<3> pose_at(const Motion<3>& motion, const Instant& now) {
  if (motion.due == now.tick) return {motion.position, motion.rotation};
  const Real seconds = now.seconds_since(motion.due);
  const Rotation<3> turned = turn(motion.spin, seconds);
  const Vector3 x = turned.col(0), y = turned.col(1), z = turned.col(2);
  Pose<3> pose;
  pose.position = add_product(seconds, motion.velocity, motion.position);
  for (int i = 0; i < 3; ++i) {
    const Vector3 axis = motion.rotation.col(i);
    pose.rotation.col(i) = add_product(axis[2], z, add_product(axis[1], y, Vector3(axis[0] * x)));
  }
  return pose;
}

Pose<2> pose_at(const Motion<2>& motion, const Instant& now) {
  if (motion.due == now.tick) return {motion.position, motion.rotation};
  const Real seconds = now.seconds_since(motion.due);
  return {motion.position + seconds * motion.velocity, turn(motion.spin, seconds) * motion.rotation};
}

}  // namespace sazare::state
