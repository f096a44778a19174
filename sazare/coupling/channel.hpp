#pragma once

/// How the messages of a coupling travel between the two sides: in one process or between two programs.
///
/// The continuum leads: it opens the channel with the shape and gets the forces at the beginning, exchanges a motion for forces
/// as often as it goes through windows, and closes. What stands on the bodies' end answers in the same order.

#include <optional>

#include "sazare/coupling/window_messages.hpp"

namespace sazare::coupling {

/// The end of the continuum.
class ContinuumChannel {
public:
  virtual ~ContinuumChannel() = default;

  /// Tells the shape, once; the forces are those at the beginning (window -1).
  virtual SurfaceForce open(const SurfaceShape& shape) = 0;

  /// Tells a motion and waits for the forces of the same window and pass.
  virtual SurfaceForce exchange(const SurfaceMotion& motion) = 0;

  /// Accepts the last window; nothing follows.
  virtual void close() = 0;
};

/// The end of the bodies.
class BodyChannel {
public:
  virtual ~BodyChannel() = default;

  /// Waits for the shape, which the first `answer` answers.
  virtual SurfaceShape open() = 0;

  /// Waits for the next motion; none when the continuum has closed.
  virtual std::optional<SurfaceMotion> receive() = 0;

  virtual void answer(const SurfaceForce& force) = 0;
};

}  // namespace sazare::coupling
