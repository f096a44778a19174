#pragma once

/// The side of the bodies in a coupling: whatever the method, they feel the surface as a moving wall.

#include <Eigen/Geometry>

#include "sazare/core/archive.hpp"
#include "sazare/coupling/channel.hpp"

namespace sazare::methods::hybrid {

class BodySide {
public:
  virtual ~BodySide() = default;

  /// Puts the surface among the bodies, before `start` or before `columns` reads. Throws UserError where a window is no whole
  /// number of the bodies' steps, or nothing is near the surface.
  virtual void attach(const coupling::SurfaceShape& shape) = 0;

  /// Evaluates the beginning; the forces are those of window -1.
  virtual coupling::SurfaceForce start() = 0;

  /// Goes through a window: the next one, or with a higher pass the last one again, from its beginning.
  virtual coupling::SurfaceForce answer(const coupling::SurfaceMotion& motion) = 0;

  /// Goes back to the beginning of the last window, as if it had not come.
  virtual void take_back() = 0;

  /// Windows that were gone through; the last one counts, though it may be gone through again.
  virtual std::int64_t windows() const = 0;
  virtual std::int64_t steps_per_window() const = 0;

  virtual void columns(Archive& archive) = 0;
};

/// Where a side of bodies of any method stands among the windows.
class WindowCourse {
public:
  /// Throws UserError where the window is no whole number of steps of the bodies, which are called so in words.
  void open(const coupling::SurfaceShape& shape, Real step, const char* bodies);
  /// Before the first window: the same surface elsewhere.
  void move_to(const coupling::SurfaceShape& shape) { shape_ = shape; }

  /// True where a window begins that was not there before, false where the last one is gone through again. Throws UserError
  /// where a motion is out of turn, or of another surface. `can_repeat`: the bodies can go back to the last window's beginning.
  bool begin(const coupling::SurfaceMotion& motion, bool can_repeat);
  void take_back();

  const coupling::SurfaceShape& shape() const { return shape_; }
  std::int64_t steps() const { return steps_; }            ///< of the bodies in a window
  std::int64_t windows() const { return windows_; }        ///< gone through
  const std::vector<Real>& from() const { return from_; }  ///< displacements at the beginning of the last window [m]
  const std::vector<Real>& to() const { return to_; }      ///< and at its end [m]

  void columns(Archive& archive);

private:
  coupling::SurfaceShape shape_;
  const char* bodies_ = "";
  std::int64_t steps_ = 0, windows_ = 0;
  std::vector<Real> from_, to_;
};

/// Throws UserError where the bodies are further from the surface than it is long.
void check_near(const Eigen::AlignedBox3d& surface, const Eigen::AlignedBox3d& bodies);

/// Both sides in one process: what the continuum says is answered at once.
class DirectChannel final : public coupling::ContinuumChannel {
public:
  /// The bodies must outlive the channel, and have the surface already when a run is resumed.
  explicit DirectChannel(BodySide& bodies) : bodies_(&bodies) {}

  coupling::SurfaceForce open(const coupling::SurfaceShape& shape) override {
    bodies_->attach(shape);
    return bodies_->start();
  }
  coupling::SurfaceForce exchange(const coupling::SurfaceMotion& motion) override { return bodies_->answer(motion); }
  void close() override {}

private:
  BodySide* bodies_;
};

}  // namespace sazare::methods::hybrid
