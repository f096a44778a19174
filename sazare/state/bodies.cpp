#include "sazare/state/bodies.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "sazare/core/lane_records.hpp"

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
  return Quaternion(1, half.x(), half.y(), half.z()).normalized().toRotationMatrix();
}

Rotation<2> turn(const Angular<2>& spin, Real seconds) {
  const Real angle = seconds * spin[0];
  Rotation<2> rotation;
  rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return rotation;
}

namespace {

/// Poses of `lane_count` bodies.
[[gnu::flatten]] void poses_in_lanes(const LanePointers<const Motion<3>>& bodies, const Instant& now,
                                     const LanePointers<Pose<3>>& poses) {
  static_assert(offsetof(Motion<3>, velocity) == 18 * sizeof(Real) && offsetof(Motion<3>, spin) == 24 * sizeof(Real));
  Lanes seconds{};
  for (std::size_t lane = 0; lane < lane_count; ++lane) seconds[static_cast<int>(lane)] = now.seconds_since(bodies[lane]->due);
  const auto n = load_records<28>(bodies);
  const LaneMatrix rotation{{LaneVector{{n[3], n[4], n[5]}}, LaneVector{{n[6], n[7], n[8]}}, LaneVector{{n[9], n[10], n[11]}}}};
  const LaneVector position = add_product(seconds, LaneVector{{n[18], n[19], n[20]}}, {{n[0], n[1], n[2]}});
  const LaneVector half = (0.5 * seconds) * LaneVector{{n[24], n[25], n[26]}};
  const LaneMatrix r = rotation_of(2.0 / (1.0 + dot(half, half)), half[0], half[1], half[2], broadcast(1)) * rotation;
  store_records(std::bit_cast<std::array<Lanes, 12>>(std::array{position, r[0], r[1], r[2]}), poses);
}

}  // namespace

void poses_at(std::span<const Motion<3>> motion, const Instant& now, std::span<Pose<3>> poses) {
  LanePointers<const Motion<3>> bodies;
  LanePointers<Pose<3>> to;
  for (std::size_t first = 0; first < poses.size(); first += lane_count) {
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const std::size_t body = std::min(first + lane, poses.size() - 1);
      bodies[lane] = &motion[body];
      to[lane] = &poses[body];
    }
    poses_in_lanes(bodies, now, to);
  }
}

void poses_at(std::span<const Motion<2>> motion, const Instant& now, std::span<Pose<2>> poses) {
  for (std::size_t body = 0; body < poses.size(); ++body) poses[body] = pose_at(motion[body], now);
}

}  // namespace sazare::state
