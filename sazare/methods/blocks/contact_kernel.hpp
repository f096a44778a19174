#pragma once

/// The touching spheres of one pair of blocks.

#include "sazare/levels/terms/slot.hpp"
#include "sazare/levels/terms/term.hpp"
#include "sazare/methods/blocks/contact_surface.hpp"

namespace sazare::methods::blocks {

/// A block as its contacts see it.
struct ContactBody {
  const state::Motion<3>& motion;
  const state::Inertia<3>& inertia;
  const state::Strain* strain = nullptr;  ///< none where it is rigid

  state::StrainedPose pose() const {
    const state::Pose<3> rigid{motion.position, motion.rotation};
    return strain == nullptr ? state::StrainedPose(rigid) : state::StrainedPose(rigid, strain->strain);
  }

  /// Velocity that its strain gives to a point of the undeformed block, in the body frame [m/s].
  Vector3 straining(const Vector3& place) const {
    return strain == nullptr ? Vector3(Vector3::Zero()) : Vector3(motion.rotation * (tensor_of(strain->predicted_rate) * place));
  }

  /// 1/mass that the block shows to an impulse along a unit vector at the end of an arm, were it rigid [1/kg].
  Real softness(const Vector3& arm, const Vector3& direction) const {
    const Vector3 turning = motion.rotation.transpose() * arm.cross(direction);
    return 1 / inertia.mass + turning.cwiseAbs2().dot(inertia.inverse_moments);
  }
  /// The same where strain moves the end of the arm as it moves a point of the undeformed block, in the body frame.
  Real softness(const Vector3& arm, const Vector3& direction, const Vector3& place) const {
    if (strain == nullptr) return softness(arm, direction);
    const Vector3 along = motion.rotation.transpose() * direction;
    return softness(arm, direction) + strain->inverse_inertia * force_on_strain(along, place).squaredNorm();
  }
};

/// Overlap of two spheres, and where; `T` is Real or Lanes.
template <class T>
struct SphereTouchOf {
  T overlap{};         ///< [m], negative when apart
  VectorOf<T> normal;  ///< from the first to the second
  VectorOf<T> point;   ///< between the surfaces [m]
  T arm{}, other_arm{};  ///< from the centres of both spheres to it [m]
};
using SphereTouch = SphereTouchOf<Real>;

/// The touch of two spheres that know a radius and where their centre is.
template <class Sphere, class T = decltype(Sphere::radius)>
SphereTouchOf<T> touch(const Sphere& a, const Sphere& b) {
  const VectorOf<T> apart = b.centre - a.centre;
  const T distance = square_root(dot(apart, apart));
  SphereTouchOf<T> at;
  at.overlap = a.radius + b.radius - distance;
  at.normal = (1.0 / distance) * apart;
  at.arm = a.radius - 0.5 * at.overlap;
  at.other_arm = b.radius - 0.5 * at.overlap;
  at.point = a.centre + at.arm * at.normal;
  return at;
}

/// On the strains of both blocks, see terms/strain_forces.hpp.
struct ContactStrainForce {
  using Numbers = terms::StrainForces<2, 2>::Numbers;

  Numbers total = Numbers::Zero(), dashpot = Numbers::Zero(), friction = Numbers::Zero();
};

/// How far two bodies were apart, and where: what they have moved since then tells which spheres cannot touch.
struct Clearance {
  Real gap = 0;   ///< between their nearest spheres [m], negative when they overlap
  Real good = 0;  ///< for so much motion [m]; 0 before the first time
  std::int8_t is_known = 0;
  std::int8_t is_distant = 0;    ///< too far apart to meet within two base steps, when last evaluated
  std::int16_t is_inactive = 0;  ///< evaluated at base steps only; no gap follows, for checkpoints have these records as they lie
  Index near = 0;                ///< so many of the spheres, the first ones, may touch before it is measured anew
  std::int64_t evaluations = 0;  ///< since it was measured
  Vector3 apart = Vector3::Zero();
  Matrix3 first = Matrix3::Zero(), second = Matrix3::Zero();  ///< rotations, or deformation gradients

  /// How far any point of either has moved against the other since then, at most [m].
  Real moved(const state::StrainedPose& a, const state::StrainedPose& b, Real first_reach, Real second_reach) const {
    return (b.position - a.position - apart).norm() + first_reach * (a.gradient() - first).norm() +
           second_reach * (b.gradient() - second).norm();
  }
};

static_assert(sizeof(Clearance) == 25 * sizeof(Real));

/// Forces of a pair, or of two of its spheres. Kernels write it in fours of doubles.
struct alignas(32) ContactForce {
  terms::PairForce<3> total, dashpot, friction;

  ContactForce& operator+=(const ContactForce& other) {
    total += other.total;
    dashpot += other.dashpot;
    friction += other.friction;
    return *this;
  }
};

/// Rates of a body that shows this softness [1/kg] to a number of spheres.
inline terms::Rates contact_rates(const laws::SphereContact& law, Real count, Real softness) {
  Real damping = 0;  // the step's cap needs no smaller step
  if (law.cap == laws::DampingCap::literal) damping = law.damping;
  if (law.cap == laws::DampingCap::critical) damping = std::min(law.damping, 2 * std::sqrt(law.stiffness / (softness * count)));
  return {count * law.stiffness * softness, count * damping * softness};
}

/// Turns what a contact of two spheres remembers with it, for `seconds` [s]. `arm` and `other_arm` are from the two centres to the
/// point of contact [m]: their sum is the distance of the centres, whose motion tilts the normal, and by these lengths the spins
/// of both bodies [rad/s] count about it. `opening` is their motion at the point against each other [m/s].
template <class T>
void turn_with_spheres(laws::SphereMemoryOf<T>& memory, const VectorOf<T>& normal, const VectorOf<T>& opening, T arm, T other_arm,
                       const VectorOf<T>& spin, const VectorOf<T>& other_spin, T seconds) {
  const T seconds_by_distance = seconds / (arm + other_arm);
  const VectorOf<T> turning = add_product(arm, spin, VectorOf<T>(other_arm * other_spin));
  memory.turn(normal, seconds_by_distance * (opening + cross(turning, normal)), T(seconds_by_distance * dot(turning, normal)));
}

/// Force at a point on what lies along the normal, with its motion there against the other body [m/s]. `softness` tells the
/// 1/mass that both show along a direction; `shared` holds overlap, step and number of contacts; the memory has been turned with
/// the contact. `T` is Real or Lanes.
template <class T, class Softness>
laws::SphereForceOf<T> force_at(const laws::SphereContact& law, const VectorOf<T>& normal, const VectorOf<T>& opening,
                                const Softness& softness, laws::SphereMotionOf<T> shared, laws::SphereMemoryOf<T>& memory) {
  shared.opening_speed = dot(opening, normal);
  shared.sliding = opening - shared.opening_speed * normal;
  const T speed = square_root(dot(shared.sliding, shared.sliding));
  const VectorOf<T> direction = select(speed > 0.0, 1.0 / speed, T{}) * shared.sliding;
  shared.normal_mass = 1.0 / softness(normal);
  shared.sliding_mass = 1.0 / softness(direction);
  return laws::sphere_force(law, shared, memory);
}

}  // namespace sazare::methods::blocks
