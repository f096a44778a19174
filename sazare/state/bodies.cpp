#include "sazare/state/bodies.hpp"

#include <array>
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

Real largest_softness(const Bodies<3>& bodies, Index body) {
  const auto n = static_cast<std::size_t>(body);
  Real by_turning = bodies.inertia[n].inverse_moments.maxCoeff();
  if (!bodies.strain.empty()) by_turning += bodies.strain[n].inverse_inertia;
  return 1 / bodies.inertia[n].mass + bodies.reach[n] * bodies.reach[n] * by_turning;
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
  return Quaternion(1, half.x(), half.y(), half.z()).normalized().toRotationMatrix();
}

Rotation<2> turn(const Angular<2>& spin, Real seconds) {
  const Real angle = seconds * spin[0];
  Rotation<2> rotation;
  rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return rotation;
}

namespace {

/// a b, where both are given by their columns.
Rotation<3> product(const std::array<Vector3, 3>& a, const Rotation<3>& b) {
  Rotation<3> result;
  for (int i = 0; i < 3; ++i) result.col(i) = add_product(b(2, i), a[2], add_product(b(1, i), a[1], Vector3(b(0, i) * a[0])));
  return result;
}

Pose<3> rounded_pose(const Motion<3>& motion, Real seconds) {
  const Vector3 half = 0.5 * seconds * motion.spin;
  const auto turned = rotation_of<Real>(2 / (1 + dot(half, half)), half[0], half[1], half[2], 1);
  return {add_product(seconds, motion.velocity, motion.position), product(turned, motion.rotation)};
}

}  // namespace

void poses_at(std::span<const Motion<3>> motion, const Instant& now, std::span<Pose<3>> poses) {
  for (std::size_t body = 0; body < poses.size(); ++body)
    poses[body] = rounded_pose(motion[body], now.seconds_since(motion[body].due));
}

void poses_at(std::span<const Motion<2>> motion, const Instant& now, std::span<Pose<2>> poses) {
  for (std::size_t body = 0; body < poses.size(); ++body) poses[body] = pose_at(motion[body], now);
}

}  // namespace sazare::state
