#include "sazare/runs/run_clocks.hpp"

#include <fmt/format.h>

#include "sazare/cases/clocks.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/error.hpp"

namespace sazare::runs {

namespace {

std::int64_t whole(std::string_view longer_name, Real longer, std::string_view shorter_name, Real shorter) {
  if (const auto count = cases::whole_multiple(longer, shorter)) return *count;
  throw UserError(fmt::format("clocks do not nest: {} = {} s is not a whole multiple of {} = {} s", longer_name, longer,
                              shorter_name, shorter));
}

}  // namespace

void check_step(const cases::CaseSource& file, Real history_interval, std::string_view step_name, Real step) {
  if (cases::whole_multiple(history_interval, step)) return;
  refuse(file, "time",
         fmt::format("the {} is {} s: history_interval = {} s cannot be walked in such steps", step_name,
                     cases::short_number(step, 4), cases::short_number(history_interval, 4)),
         fmt::format("it follows from the stiffness, density and size of the bodies, one of which is too large or too small to be "
                     "meant so: check their units, or give time.{}",
                     step_name));
}

RunClocks make_clocks(const ClockIntervals& time, std::string_view step_name, Real step) {
  RunClocks clocks;
  clocks.end = time.end;
  clocks.rows = whole("end", time.end, "history_interval", time.history_interval);
  clocks.steps_per_row = whole("history_interval", time.history_interval, step_name, step);
  clocks.rows_per_snapshot = whole("snapshot_interval", time.snapshot_interval, "history_interval", time.history_interval);
  return clocks;
}

}  // namespace sazare::runs
