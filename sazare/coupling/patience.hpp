#pragma once

/// Waiting for a file without burning the processor.

#include <algorithm>
#include <chrono>
#include <thread>

#include "sazare/core/vector.hpp"

namespace sazare::coupling {

/// Sleeps longer and longer: a share of the time waited so far, so that an answer is seen late by at most that share, and
/// a long wait costs no more than a thousand looks a second. Where it is known how long the last wait was, half of that is slept
/// through at first: looks cost more processor time than all else that waiting does.
class Patience {
public:
  /// `last_wait` for the like of this one [s]; 0 where it is not known.
  explicit Patience(Real last_wait = 0)
      : nap_(std::min(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<Real>(0.5 * last_wait)), longest_nap)) {}

  void sleep() {
    const Clock::duration grown = std::clamp<Clock::duration>((Clock::now() - began_) / 64, shortest, longest);
    std::this_thread::sleep_for(std::max(grown, nap_));
    nap_ = {};
  }

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
  static constexpr Clock::duration longest_nap = std::chrono::milliseconds(20);

  Clock::time_point began_ = Clock::now();
  Clock::time_point next_glance_ = began_ + std::chrono::milliseconds(100);
  Clock::duration nap_;
};

}  // namespace sazare::coupling
