#pragma once

/// Waiting for a file without burning the processor.

#include <algorithm>
#include <chrono>
#include <thread>

#include "sazare/core/vector.hpp"

namespace sazare::coupling {

/// Sleeps longer and longer: a share of what has been waited so far, so that an answer is seen late by that share at most, and
/// a long wait costs no more than a thousand looks a second.
class Patience {
public:
  void sleep() { std::this_thread::sleep_for(std::clamp<Clock::duration>((Clock::now() - began_) / 64, shortest, longest)); }

  /// Waited so far [s].
  Real waited() const { return std::chrono::duration<Real>(Clock::now() - began_).count(); }

  /// Now and then: whether it is time to look after the partner.
  bool glance_is_due() {
    if (Clock::now() < next_glance_) return false;
    next_glance_ = Clock::now() + std::chrono::milliseconds(100);
    return true;
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr Clock::duration shortest = std::chrono::microseconds(10);
  static constexpr Clock::duration longest = std::chrono::milliseconds(1);

  Clock::time_point began_ = Clock::now();
  Clock::time_point next_glance_ = began_ + std::chrono::milliseconds(100);
};

}  // namespace sazare::coupling
