#pragma once

/// The touching spheres of one pair of blocks.

#include <span>

#include "sazare/laws/sphere_contact.hpp"
#include "sazare/methods/blocks/contact_surface.hpp"
#include "sazare/state/impulse.hpp"

namespace sazare::methods::blocks {

/// A block as its contacts see it.
struct ContactBody {
  const state::Motion<3>& motion;
  const state::Inertia<3>& inertia;
  state::Pose<3> pose;

  /// 1/mass that the block shows to an impulse along a unit vector at the end of an arm [1/kg].
  Real softness(const Vector3& arm, const Vector3& direction) const {
    const Vector3 turning = pose.rotation.transpose() * arm.cross(direction);
    return 1 / inertia.mass + turning.cwiseAbs2().dot(inertia.inverse_moments);
  }
  Vector3 velocity_at(const Vector3& arm) const { return motion.velocity + motion.spin.cross(arm); }
};

/// Overlap of two spheres, and where.
struct SphereTouch {
  Real overlap = 0;  ///< [m], negative when apart
  Vector3 normal;    ///< from the first to the second
  Vector3 point;     ///< between the surfaces [m]
};

inline SphereTouch touch(const ContactSphere& a, const ContactSphere& b, const state::Pose<3>& first,
                         const state::Pose<3>& second) {
  const Vector3 from = first.position + first.rotation * a.centre;
  const Vector3 apart = second.position + second.rotation * b.centre - from;
  const Real distance = apart.norm();
  SphereTouch at;
  at.overlap = a.radius + b.radius - distance;
  at.normal = apart / distance;
  at.point = from + (a.radius - 0.5 * at.overlap) * at.normal;
  return at;
}

/// How far two bodies that do not touch were apart, and where: while they have moved less than the gap they do not touch.
struct Clearance {
  Real gap = 0;  ///< between their nearest spheres; 0 when unknown or touching [m]
  Vector3 apart;
  Matrix3 first, second;

  bool holds(const state::Pose<3>& a, const state::Pose<3>& b, Real first_reach, Real second_reach) const {
    if (gap <= 0) return false;
    const Real moved = (b.position - a.position - apart).norm() + first_reach * (a.rotation - first).norm() +
                       second_reach * (b.rotation - second).norm();
    return moved < gap;
  }
};

/// What a pair gives to each of its bodies over the time it acts.
struct ContactImpulse {
  state::Wrench<3> total;
  state::Wrench<3> dashpot;
  state::Wrench<3> friction;
};

inline void add_force(state::Wrench<3>& sum, const Vector3& arm, const Vector3& impulse) {
  sum += {impulse, arm.cross(impulse)};
}

/// Adds one touching pair of spheres to the impulses of both bodies.
inline void add_touch(const laws::SphereContact& law, const SphereTouch& at, Real pressed, Real shared_step, Real acting,
                      const ContactBody& first, const ContactBody& second, ContactImpulse& on_first,
                      ContactImpulse& on_second) {
  const Vector3 arm = at.point - first.pose.position, other_arm = at.point - second.pose.position;
  const Vector3 opening = second.velocity_at(other_arm) - first.velocity_at(arm);
  laws::SphereMotion motion;
  motion.overlap = pressed;
  motion.opening_speed = opening.dot(at.normal);
  const Vector3 sliding = opening - motion.opening_speed * at.normal;
  motion.sliding_speed = sliding.norm();
  const Vector3 direction = motion.sliding_speed > 0 ? Vector3(sliding / motion.sliding_speed) : Vector3(Vector3::Zero());
  motion.normal_mass = 1 / (first.softness(arm, at.normal) + second.softness(other_arm, at.normal));
  motion.sliding_mass = 1 / (first.softness(arm, direction) + second.softness(other_arm, direction));
  motion.shared_step = shared_step;
  const laws::SphereForce force = laws::sphere_force(law, motion);
  const Vector3 dashpot = (acting * force.dashpot) * at.normal, friction = (-acting * force.friction) * direction;
  const Vector3 all = (acting * force.elastic) * at.normal + dashpot + friction;
  add_force(on_second.total, other_arm, all);
  add_force(on_second.dashpot, other_arm, dashpot);
  add_force(on_second.friction, other_arm, friction);
  add_force(on_first.total, arm, -all);
  add_force(on_first.dashpot, arm, -dashpot);
  add_force(on_first.friction, arm, -friction);
}

}  // namespace sazare::methods::blocks
