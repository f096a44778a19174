#include "sazare/methods/blocks/run/material_points.hpp"

#include "sazare/levels/motion/kick.hpp"

namespace sazare::runs {

PlacedElement::PlacedElement(const state::Bodies<3>& bodies, const state::Pose<3>& now, Index element)
    : pose_(&now), start_(&bodies.start[at(element)]), start_rotation_(state::start_rotation(bodies, element)) {}

Vector3 PlacedElement::arm(const Vector3& start) const {
  const Vector3 in_body = start_rotation_.transpose() * (start - *start_);
  return pose_->rotation * in_body;
}

Vector3 PlacedElement::turned(const Vector3& start) const {
  const Matrix3 turned = pose_->rotation * start_rotation_.transpose();
  return turned * start;
}

Vector3 point_velocity(const state::Bodies<3>& bodies, const levels::BodyNow<3>& now, Index element, const Vector3& start) {
  const Vector3 spin =
      motion::spin_of(now.pose.rotation, bodies.inertia[at(element)], bodies.locks[at(element)], now.angular_momentum);
  return now.velocity + spin.cross(PlacedElement(bodies, now.pose, element).arm(start));
}

}  // namespace sazare::runs
