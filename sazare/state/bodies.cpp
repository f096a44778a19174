#include "sazare/state/bodies.hpp"

#include <cmath>

namespace sazare::state {

Index add_body(Bodies<3>& bodies, Real mass, const Vector3& centre, const Vector3& principal_moments,
               const Quaternion& orientation, Real reach) {
  Motion<3> motion;
  motion.position = centre;
  motion.velocity.setZero();
  motion.foreseen_velocity.setZero();
  motion.rotation = orientation.toRotationMatrix();
  motion.spin.setZero();
  motion.foreseen_spin.setZero();
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
  motion.foreseen_velocity.setZero();
  motion.rotation.setIdentity();
  motion.spin.setZero();
  motion.foreseen_spin.setZero();
  motion.angular_momentum.setZero();
  bodies.motion.push_back(motion);
  bodies.inertia.push_back({0, Angular<2>(1 / moment), mass});
  bodies.reach.push_back(reach);
  bodies.locks.push_back({});
  bodies.start.push_back(centre);
  bodies.start_orientation.push_back(0);
  return bodies.size() - 1;
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

}  // namespace sazare::state
