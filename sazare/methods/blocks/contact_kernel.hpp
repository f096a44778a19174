#pragma once

/// The touching spheres of one pair of blocks.

#include "sazare/methods/blocks/contact_surface.hpp"
#include "sazare/terms/slot.hpp"
#include "sazare/terms/term.hpp"

namespace sazare::methods::blocks {

/// A block as its contacts see it.
struct ContactBody {
  const state::Motion<3>& motion;
  const state::Inertia<3>& inertia;

  state::Pose<3> pose() const { return {motion.position, motion.rotation}; }

  /// 1/mass that the block shows to an impulse along a unit vector at the end of an arm [1/kg].
  Real softness(const Vector3& arm, const Vector3& direction) const {
    const Vector3 turning = motion.rotation.transpose() * arm.cross(direction);
    return 1 / inertia.mass + turning.cwiseAbs2().dot(inertia.inverse_moments);
  }
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

/// How far two bodies were apart, and where: what they have moved since then tells which spheres cannot touch.
struct Clearance {
  Real gap = 0;  ///< between their nearest spheres [m], negative when they overlap
  std::int8_t is_known = 0;
  std::int8_t is_distant = 0;  ///< too far apart to meet within two base steps, when last evaluated
  std::int8_t rests = 0;       ///< evaluated at base steps only
  Vector3 apart = Vector3::Zero();
  Matrix3 first = Matrix3::Zero(), second = Matrix3::Zero();

  /// How far any point of either has moved against the other since then, at most [m].
  Real moved(const state::Pose<3>& a, const state::Pose<3>& b, Real first_reach, Real second_reach) const {
    return (b.position - a.position - apart).norm() + first_reach * (a.rotation - first).norm() +
           second_reach * (b.rotation - second).norm();
  }
};

/// Forces of a pair.
struct ContactForce {
  terms::PairForce<3> total, dashpot, friction;
};

/// Two touching spheres and how their pair is evaluated.
struct Touching {
  SphereTouch at;
  SpherePair* pair = nullptr;
};

/// Rates of a body that shows this softness [1/kg] to a number of spheres.
inline terms::Rates contact_rates(const laws::SphereContact& law, Real count, Real softness) {
  Real damping = 0;  // the step's cap needs no smaller step
  if (law.cap == laws::DampingCap::literal) damping = law.damping;
  if (law.cap == laws::DampingCap::critical) damping = std::min(law.damping, 2 * std::sqrt(law.stiffness / (softness * count)));
  return {count * law.stiffness * softness, count * damping * softness};
}

/// Force at a point on what lies along the normal, with its motion there against the other body [m/s]. `softness` tells the
/// 1/mass that both show along a direction; `shared` holds overlap, step and number of contacts.
template <class Softness>
laws::SphereForce force_at(const laws::SphereContact& law, const Vector3& normal, const Vector3& opening, Softness&& softness,
                           laws::SphereMotion shared, laws::SphereMemory& memory) {
  shared.opening_speed = opening.dot(normal);
  shared.sliding = opening - shared.opening_speed * normal;
  const Real speed = shared.sliding.norm();
  const Vector3 direction = speed > 0 ? Vector3(shared.sliding / speed) : Vector3(Vector3::Zero());
  shared.normal_mass = 1 / softness(normal);
  shared.sliding_mass = 1 / softness(direction);
  memory.friction -= normal.dot(memory.friction) * normal;  // the plane of contact turns
  return laws::sphere_force(law, shared, memory);
}

/// Adds touching spheres to the force of their pair. `shared` holds what all spheres of the pair have in common.
inline void add_touch(const laws::SphereContact& law, const Touching& touching, laws::SphereMotion shared,
                      const ContactBody& first, const ContactBody& second, ContactForce& sum) {
  const SphereTouch& at = touching.at;
  const Vector3 arm = at.point - first.motion.position, other_arm = at.point - second.motion.position;
  const Vector3 opening = second.motion.velocity_at(other_arm) - first.motion.velocity_at(arm);
  shared.overlap = at.overlap - touching.pair->rest;
  const laws::SphereForce force = force_at(
      law, at.normal, opening,
      [&](const Vector3& along) { return first.softness(arm, along) + second.softness(other_arm, along); }, shared,
      touching.pair->memory);
  const Vector3 dashpot = force.dashpot * at.normal;
  sum.dashpot.add_at(arm, other_arm, dashpot);
  sum.friction.add_at(arm, other_arm, force.friction);
  sum.total.add_at(arm, other_arm, force.elastic * at.normal + dashpot + force.friction);
}

}  // namespace sazare::methods::blocks
