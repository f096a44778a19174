#pragma once

#include <string_view>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/tables.hpp"
#include "sazare/core/time.hpp"

namespace sazare::runs {

/// The clocks of a run as whole numbers of one another: times are places in a count, never sums.
struct RunClocks {
  std::int64_t rows = 0;               ///< history intervals to the end
  std::int64_t steps_per_row = 0;      ///< base steps in a history interval
  std::int64_t rows_per_snapshot = 0;  ///< history intervals in a snapshot interval
  Real end = 0;                        ///< [s]

  std::int64_t steps() const { return rows * steps_per_row; }
  bool is_row(std::int64_t step) const { return step % steps_per_row == 0; }
  bool is_snapshot(std::int64_t step) const { return step % (steps_per_row * rows_per_snapshot) == 0; }

  /// Time of a base step [s]; over the steps in a second, which is a whole number more often than the step is a short one.
  Real time(std::int64_t step) const {
    if (step == steps()) return end;
    if (!is_row(step)) return static_cast<Real>(step) / (static_cast<Real>(steps()) / end);
    return static_cast<Real>(step / steps_per_row) / (static_cast<Real>(rows) / end);
  }
};

/// The intervals of a case [s].
struct ClockIntervals {
  Real end = 0, history_interval = 0, snapshot_interval = 0;
};

/// Refuses a case whose step [s] is no number, or none that a history interval [s] can be walked in.
void check_step(const cases::CaseSource& file, Real history_interval, std::string_view step_name, Real step);

/// `step_name` is the key of the step [s] in the case. Throws UserError when the clocks do not nest in whole steps.
RunClocks make_clocks(const ClockIntervals& intervals, std::string_view step_name, Real step);

inline RunClocks make_clocks(const cases::UniformTime& time, Real step) {
  return make_clocks({time.end, time.history_interval, time.snapshot_interval}, "step", step);
}

/// The clocks of a case, whose step is given or follows from its bodies. Refuses at its [time] what is no step at all.
template <class Time>
RunClocks make_clocks(const cases::CaseSource& file, const Time& time, std::string_view step_name, Real step) {
  check_step(file, time.history_interval, step_name, step);
  return make_clocks({time.end, time.history_interval, time.snapshot_interval}, step_name, step);
}

}  // namespace sazare::runs
