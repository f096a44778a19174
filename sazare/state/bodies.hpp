#pragma once

/// Everything that moves, as records in columns; no behaviour. A body's number is its place and never changes.
///
/// `Motion` begins with what forces and kicks need of a body, in three cache lines, because forces gather bodies in any
/// order. What only the body's own kick needs follows, and stands apart in `Inertia`.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "sazare/core/large_tables.hpp"
#include "sazare/core/rotation.hpp"
#include "sazare/core/time.hpp"
#include "sazare/state/strain.hpp"

namespace sazare::state {

/// Position and rotation are those at `due`, the body's next own time: every force on it is evaluated at its own times.
template <int D>
struct alignas(64) Motion {
  Vector<D> position;           ///< centre of mass at `due` [m]
  Rotation<D> rotation;         ///< body frame to world, at `due`
  Vector<D> predicted_velocity;  ///< at `due` [m/s]
  Angular<D> predicted_spin;     ///< at `due` [rad/s]
  Vector<D> velocity;           ///< constant from `last_kick` to `due` [m/s]
  Angular<D> angular_momentum;  ///< [kg m2/s]
  Angular<D> spin;              ///< angular velocity from `last_kick` to `due` [rad/s]
  Tick last_kick = -1;
  Tick due = 0;

  /// Velocity at `due` of a point of the body, an arm from its centre [m/s].
  Vector<D> velocity_at(const Vector<D>& arm) const { return predicted_velocity + turned(predicted_spin, arm); }
};

/// What forces need of a body, from the first byte of its motion on.
template <int D>
inline constexpr std::size_t bytes_for_forces = offsetof(Motion<D>, velocity);

/// Axes along or about which a body may not move.
struct Locks {
  std::uint8_t translation = 0;  ///< bit per axis
  std::uint8_t rotation = 0;

  bool any() const { return translation != 0 || rotation != 0; }
};

template <int D>
struct Inertia;

/// The body frame lies in the principal axes of inertia.
template <>
struct alignas(64) Inertia<3> {
  Quaternion orientation;   ///< body frame to world, at `due`
  Vector3 inverse_moments;  ///< [1/(kg m2)]
  Real mass = 0;            ///< [kg]
};

template <>
struct Inertia<2> {
  Real angle = 0;  ///< [rad], at `due`
  Angular<2> inverse_moments;
  Real mass = 0;  ///< [kg]
};

/// An orientation as a body's inertia holds it: an angle [rad] in the plane.
template <int D>
using Orientation = std::conditional_t<D == 2, Real, Quaternion>;

template <int D>
struct Bodies {
  std::vector<Motion<D>> motion;
  std::vector<Inertia<D>> inertia;
  std::vector<Locks> locks;
  std::vector<Real> reach;                        ///< distance of the farthest point of a body from its centre [m]
  std::vector<Vector<D>> start;                   ///< position at the beginning [m]
  std::vector<Orientation<D>> start_orientation;  ///< as a rotation it would be twice as large, and few ask for it
  std::vector<Strain> strain;                     ///< in space; none where all bodies are rigid
  Vector<D> pole = Vector<D>::Zero();             ///< moments of forces are about it: a fixed point among the bodies [m]

  Index size() const { return static_cast<Index>(motion.size()); }
};

/// Room for so many bodies.
template <int D>
void reserve(Bodies<D>& bodies, std::size_t count) {
  reserve_on_large_pages(bodies.motion, count);
  reserve_on_large_pages(bodies.inertia, count);
  bodies.locks.reserve(count);
  bodies.reach.reserve(count);
  bodies.start.reserve(count);
  bodies.start_orientation.reserve(count);
}

/// False when a body's motion is infinite or no number. A rotation is so in all of its numbers or in none.
template <int D>
bool is_finite(const Motion<D>& motion) {
  return std::isfinite(motion.position.sum() + motion.velocity.sum() + motion.angular_momentum.sum() + motion.rotation(0, 0));
}

/// Body frame to world, at the beginning.
inline Rotation<3> start_rotation(const Bodies<3>& bodies, Index body) {
  return bodies.start_orientation[static_cast<std::size_t>(body)].toRotationMatrix();
}

/// Adds a body at rest.
Index add_body(Bodies<3>& bodies, Real mass, const Vector3& centre, const Vector3& principal_moments,
               const Quaternion& orientation, Real reach);
Index add_body(Bodies<2>& bodies, Real mass, const Vector<2>& centre, Real moment, Real reach);

/// Middle of the box around all centres at the beginning: a pole for which moments keep their digits wherever the model lies.
Vector3 middle(const Bodies<3>& bodies);

/// Place of a body at a moment.
template <int D>
struct Pose {
  Vector<D> position;
  Rotation<D> rotation;
};

/// Place of a body that may be strained.
struct StrainedPose : Pose<3> {
  Matrix3 straining = Matrix3::Zero();  ///< R E

  StrainedPose(const Pose<3>& pose) : Pose<3>(pose) {}
  StrainedPose(const Pose<3>& pose, const Vector6& strain) : Pose<3>(pose), straining(pose.rotation * tensor_of(strain)) {}

  /// The deformation gradient R (1 + E).
  Matrix3 gradient() const { return rotation + straining; }
};

/// The rotation that a spin makes in a time, exact for the angle 2 atan(|spin| time / 2): its error is of third order in
/// time, and the rotation for -time is exactly its inverse.
Rotation<3> turn(const Vector3& spin, Real seconds);
Rotation<2> turn(const Angular<2>& spin, Real seconds);

/// Where a body is at any moment since its last kick.
template <int D>
Pose<D> pose_at(const Motion<D>& motion, const Instant& now) {
  if (motion.due == now.tick) return {motion.position, motion.rotation};
  const Real seconds = now.seconds_since(motion.due);
  return {motion.position + seconds * motion.velocity, turn(motion.spin, seconds) * motion.rotation};
}

inline StrainedPose strained_pose_at(const Bodies<3>& bodies, Index body, const Instant& now) {
  const auto& motion = bodies.motion[static_cast<std::size_t>(body)];
  const Pose<3> pose = pose_at(motion, now);
  if (bodies.strain.empty()) return pose;
  const Strain& strain = bodies.strain[static_cast<std::size_t>(body)];
  return {pose, strain.strain + (motion.due == now.tick ? 0 : now.seconds_since(motion.due)) * strain.rate};
}

/// 1/mass that a body shows to an impulse at any of its points, at most [1/kg].
Real largest_softness(const Bodies<3>& bodies, Index body);

/// Where several are, as many as `poses`, for rows of a history. Sums of products are rounded once, as in kernels of lanes, so
/// within some 1e-16 of what `pose_at` finds.
void poses_at(std::span<const Motion<3>> motion, const Instant& now, std::span<Pose<3>> poses);
void poses_at(std::span<const Motion<2>> motion, const Instant& now, std::span<Pose<2>> poses);

}  // namespace sazare::state
