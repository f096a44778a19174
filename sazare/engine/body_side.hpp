#pragma once

/// The side of the bodies in a coupling: whatever the method, they feel the surface as a moving wall.

#include "sazare/core/archive.hpp"
#include "sazare/coupling/channel.hpp"

namespace sazare::engine {

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

  virtual void columns(Archive& archive) = 0;
};

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

}  // namespace sazare::engine
