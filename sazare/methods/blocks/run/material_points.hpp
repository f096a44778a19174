#pragma once

/// Where points of elements are, and how fast they move.

#include "sazare/levels/simulation.hpp"

namespace sazare::runs {

/// An element at a moment, to follow points of it.
class PlacedElement {
public:
  /// At a pose that outlives it; rigid, or with a strain.
  PlacedElement(const state::Bodies<3>& bodies, const state::Pose<3>& now, Index element);
  PlacedElement(const state::Bodies<3>& bodies, const state::Pose<3>& now, Index element, const Vector6& strain);
  PlacedElement(const state::Bodies<3>& bodies, const levels::Snapshot<3>& now, Index element);

  /// Where a point that was at `start` is now, as a point of this element [m].
  Vector3 moved(const Vector3& start) const { return pose_->position + arm(start); }

  /// From the element's centre to the same point, in world axes [m].
  Vector3 arm(const Vector3& start) const;

  /// A direction of the beginning as it points now.
  Vector3 turned(const Vector3& start) const;

private:
  const state::Pose<3>* pose_;
  const Vector3* start_;
  Matrix3 start_rotation_;
  Matrix3 strain_ = Matrix3::Zero();  ///< in the body frame
  bool is_strained_ = false;
};

/// An element of a snapshot.
levels::BodyNow<3> body_of(const levels::Snapshot<3>& now, Index element);

/// Velocity [m/s] of a point that was at `start`, as a point of this element.
Vector3 point_velocity(const state::Bodies<3>& bodies, const levels::BodyNow<3>& now, Index element, const Vector3& start);

}  // namespace sazare::runs
