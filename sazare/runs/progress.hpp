#pragma once

/// How far a run is: a bar on a terminal, a plain line now and then elsewhere.

#include <chrono>
#include <cstdint>
#include <string>

#include "sazare/core/vector.hpp"

namespace sazare::runs {

/// What there is to tell.
struct ProgressState {
  Real share = 0;  ///< of the simulated time, 0..1
  Real time = 0;   ///< simulated [s]
  std::int64_t pair_evaluations = 0;
  Real smallest_step = 0;                 ///< [s]
  std::int64_t broken_joints = 0;         ///< negative: the method has none
  const char* evaluated = "evaluations";  ///< what is counted
};

/// "41 %  12 s left  2.3e7 evaluations/s ..." from what was done since `first` in `seconds`.
std::string progress_text(const ProgressState& first, const ProgressState& now, Real seconds);

/// "1 h 05 min", "3 min 20 s", "12 s"
std::string duration_text(Real seconds);

class Progress {
public:
  /// `first` is where the run begins, which after a resume is not zero.
  Progress(bool quiet, const ProgressState& first);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Whether enough time has passed since the last one for another; asked at every step.
  bool is_due() const { return !quiet_ && Clock::now() >= next_; }
  void show(const ProgressState& now);

  /// Takes the bar off the terminal.
  void clear();

private:
  using Clock = std::chrono::steady_clock;

  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  ProgressState first_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace sazare::runs
