#include "sazare/runs/material_points.hpp"

#include "sazare/motion/kick.hpp"

namespace sazare::runs {

namespace {

std::size_t at(Index index) { return static_cast<std::size_t>(index); }

/// From the element's centre to the point, in world axes [m].
Vector3 arm(const state::Bodies<3>& bodies, const engine::Snapshot<3>& now, Index element, const Vector3& start) {
  const Vector3 in_body = bodies.start_rotation[at(element)].transpose() * (start - bodies.start[at(element)]);
  return now.pose[at(element)].rotation * in_body;
}

}  // namespace

Vector3 moved_point(const state::Bodies<3>& bodies, const engine::Snapshot<3>& now, Index element, const Vector3& start) {
  return now.pose[at(element)].position + arm(bodies, now, element, start);
}

Vector3 point_velocity(const state::Bodies<3>& bodies, const engine::Snapshot<3>& now, Index element, const Vector3& start) {
  state::Motion<3> motion = bodies.motion[at(element)];
  motion.rotation = now.pose[at(element)].rotation;
  const Vector3 spin =
      motion::spin_of(motion, bodies.inertia[at(element)], bodies.locks[at(element)], now.angular_momentum[at(element)]);
  return now.velocity[at(element)] + spin.cross(arm(bodies, now, element, start));
}

}  // namespace sazare::runs
