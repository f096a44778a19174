#include "sazare/methods/blocks/run/material_points.hpp"

#include "sazare/levels/motion/kick.hpp"

namespace sazare::runs {

PlacedElement::PlacedElement(const state::Bodies<3>& bodies, const state::Pose<3>& now, Index element)
    : pose_(&now), start_(&bodies.start[at(element)]), start_rotation_(state::start_rotation(bodies, element)) {}

PlacedElement::PlacedElement(const state::Bodies<3>& bodies, const state::Pose<3>& now, Index element, const Vector6& strain)
    : PlacedElement(bodies, now, element) {
  strain_ = tensor_of(strain);
  is_strained_ = true;
}

PlacedElement::PlacedElement(const state::Bodies<3>& bodies, const levels::Snapshot<3>& now, Index element)
    : PlacedElement(bodies, now.pose[at(element)], element) {
  if (now.strain.empty()) return;
  strain_ = tensor_of(now.strain[at(element)].strain);
  is_strained_ = true;
}

Vector3 PlacedElement::arm(const Vector3& start) const {
  const Vector3 in_body = start_rotation_.transpose() * (start - *start_);
  if (is_strained_) return pose_->rotation * (in_body + strain_ * in_body);
  return pose_->rotation * in_body;
}

Vector3 PlacedElement::turned(const Vector3& start) const {
  const Matrix3 turned = pose_->rotation * start_rotation_.transpose();
  return turned * start;
}

levels::BodyNow<3> body_of(const levels::Snapshot<3>& now, Index element) {
  return {now.pose[at(element)], now.velocity[at(element)], now.angular_momentum[at(element)],
          now.strain.empty() ? state::StrainNow{} : now.strain[at(element)]};
}

Vector3 point_velocity(const state::Bodies<3>& bodies, const levels::BodyNow<3>& now, Index element, const Vector3& start) {
  const Vector3 spin =
      motion::spin_of(now.pose.rotation, bodies.inertia[at(element)], bodies.locks[at(element)], now.angular_momentum);
  if (bodies.strain.empty()) return now.velocity + spin.cross(PlacedElement(bodies, now.pose, element).arm(start));
  const Vector3 in_body = state::start_rotation(bodies, element).transpose() * (start - bodies.start[at(element)]);
  return now.velocity + spin.cross(PlacedElement(bodies, now.pose, element, now.strain.strain).arm(start)) +
         now.pose.rotation * (tensor_of(now.strain.rate) * in_body);
}

}  // namespace sazare::runs
