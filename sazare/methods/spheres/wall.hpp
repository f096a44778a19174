#pragma once

/// Walls: planes, with spheres on one side, and surfaces of triangles, which both sides see. They move as rigid bodies,
/// or a surface with its nodes.

#include <array>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/exact_vector.hpp"
#include "sazare/core/time.hpp"
#include "sazare/geometry/nodal_surface.hpp"
#include "sazare/geometry/triangle_tree.hpp"
#include "sazare/laws/ground_motion.hpp"
#include "sazare/state/spheres.hpp"

namespace sazare::methods::spheres {

/// How a wall moves: histories along the axes, and a steady turn about an axis that moves with it.
struct WallMotion {
  std::vector<std::pair<int, laws::GroundMotion>> histories;  ///< axis and history
  Vector3 pivot = Vector3::Zero();                            ///< a point of the axis at the start [m]
  Vector3 spin = Vector3::Zero();                             ///< [rad/s]

  bool moves() const { return !histories.empty() || spin.norm() > 0; }
};

/// Where a wall is at a moment.
struct WallPose {
  Vector3 shift = Vector3::Zero();     ///< [m]
  Vector3 velocity = Vector3::Zero();  ///< of the pivot [m/s]
  Vector3 spin = Vector3::Zero();      ///< [rad/s]
  Vector3 pivot = Vector3::Zero();     ///< at the start [m]
  Matrix3 turn = Matrix3::Identity();

  static WallPose of(const WallMotion& motion, Real time) {
    WallPose pose;
    for (const auto& [axis, history] : motion.histories) {
      const laws::MotionState now = history.at(time);
      pose.shift[axis] += now.displacement;
      pose.velocity[axis] += now.velocity;
    }
    pose.pivot = motion.pivot;
    pose.spin = motion.spin;
    const Real rate = motion.spin.norm();
    if (rate > 0)
      pose.turn =
          Eigen::AngleAxis<Real>(std::remainder(rate * time, 2 * std::numbers::pi), motion.spin / rate).toRotationMatrix();
    return pose;
  }

  /// A place as the wall at the start would have it.
  Vector3 into(const Vector3& place) const { return turn.transpose() * (place - pivot - shift) + pivot; }
  /// Where a place of the wall at the start is now.
  Vector3 out(const Vector3& place) const { return turn * (place - pivot) + pivot + shift; }
  Vector3 direction_out(const Vector3& direction) const { return turn * direction; }
  Vector3 velocity_at(const Vector3& place) const { return velocity + spin.cross(place - pivot - shift); }
};

struct Wall {
  std::string name;
  Index material = 0;
  Vector3 point = Vector3::Zero();            ///< of a plane, at the start [m]
  Vector3 normal = Vector3::UnitZ();          ///< of a plane, towards the spheres
  std::vector<geometry::Triangle> triangles;  ///< at the start [m]; none: a plane, or a surface that moves with its nodes
  state::PeriodicBox images;                  ///< of a surface: the axes along which it has periodic images, see `repeat_wall`
  WallMotion motion;
  Index joined = -1;  ///< walls of one material and one motion that have the same number are one surface; -1: stands alone
  geometry::NodalSurface nodal;

  /// Whether a sphere can be on either side of it.
  bool is_surface() const { return !is_plane(); }
  bool is_plane() const { return triangles.empty() && !nodal.exists(); }
};

/// A sphere whose centre has gone through a surface.
struct Passage {
  Index sphere = 0;  ///< its number
  Index wall = 0;
  Vector3 centre = Vector3::Zero();  ///< [m]
  Real time = 0;                     ///< when that was seen [s]
};

/// Force and moment of all spheres on a wall, the moment about its pivot, and the work of the wall on the spheres in this step.
struct WallLoad {
  Vector3 force = Vector3::Zero();   ///< [N]
  Vector3 moment = Vector3::Zero();  ///< [N m]
  Real work = 0;                     ///< [J]

  WallLoad& operator+=(const WallLoad& more) {
    force += more.force;
    moment += more.moment;
    work += more.work;
    return *this;
  }
};

/// Loads of parts of the spheres on a wall, added up without rounding.
struct WallLoadSums {
  ExactVector force, moment;
  ExactSum work;

  WallLoadSums& operator+=(const WallLoad& more) {
    force += more.force;
    moment += more.moment;
    work += more.work;
    return *this;
  }
  WallLoadSums& operator+=(const WallLoadSums& more) {
    force += more.force;
    moment += more.moment;
    work += more.work;
    return *this;
  }

  WallLoad load() const { return {force.value(), moment.value(), work.value()}; }
};

}  // namespace sazare::methods::spheres
