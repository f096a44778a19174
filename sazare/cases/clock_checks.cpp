#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/clocks.hpp"
#include "sazare/cases/format/number_text.hpp"

namespace sazare::cases {
namespace {

constexpr std::int64_t usual_history_rows = 200;
constexpr std::int64_t usual_snapshots = 20;
constexpr std::int64_t most_history_rows = 1'000'000;
constexpr std::int64_t most_snapshots = 10'000;

/// From the longest clock to the shortest: end, snapshot_interval, history_interval, step.
class ClockCheck {
public:
  ClockCheck(const CheckContext& context, const Entry& entry, Clocks clocks) : context_(context), entry_(entry), time_(clocks) {}

  void run() {
    check_step();
    history_ = entry_.has("history_interval") ? check_history() : choose_history();
    if (entry_.has("snapshot_interval"))
      check_snapshots();
    else
      time_.snapshot_interval = whole_fraction(time_.end, nearest_divisor(rows().value_or(1), usual_snapshots));
  }

private:
  struct Clock {
    std::string_view name;
    Real interval;
  };

  /// `nearest` is the interval that nests; a rounder one is offered beside it.
  void refuse(const Clock& wrong, const Clock& longer, const Clock& shorter, Real nearest, std::optional<Real> beneath = {}) {
    const auto round = round_fraction(time_.end, wrong.interval, beneath);
    const std::string also = round && *round != nearest ? fmt::format(", a round one {}", number_text(*round)) : "";
    context_.problems.error(entry_.place(wrong.name),
                            fmt::format("clocks do not nest: {} = {} s is not a whole multiple of {} = {} s", longer.name,
                                        short_number(longer.interval, 12), shorter.name, short_number(shorter.interval, 12)),
                            fmt::format("the nearest {} that does is {}{}", wrong.name, number_text(nearest), also));
  }

  void check_step() {
    if (!entry_.gives(time_.step_key)) return;
    if (whole_multiple(time_.end, *time_.step)) {
      base_ = time_.step;
      return;
    }
    const Clock base{time_.step_key, *time_.step};
    refuse(base, end(), base, nearest_fraction(time_.end, base.interval));
  }

  /// About 200 rows, so many that they fit the clocks that are given.
  bool choose_history() {
    const auto snapshots = entry_.gives("snapshot_interval") ? whole_multiple(time_.end, time_.snapshot_interval) : std::nullopt;
    const std::int64_t outer = snapshots.value_or(1);
    const std::int64_t wanted = std::max<std::int64_t>(1, usual_history_rows / outer);
    const auto steps = base_ ? whole_multiple(time_.end / static_cast<Real>(outer), *base_) : std::nullopt;
    const std::int64_t inner = steps ? nearest_divisor(*steps, wanted) : wanted;
    time_.history_interval = whole_fraction(time_.end, outer * inner);
    return true;
  }

  bool check_history() {
    if (!entry_.is_sound("history_interval")) return false;
    const Clock history{"history_interval", time_.history_interval};
    const bool fits_end = whole_multiple(time_.end, history.interval).has_value();
    const bool fits_base = !base_ || whole_multiple(history.interval, *base_).has_value();
    if (fits_end && fits_base) {
      warn_of_many(history, most_history_rows, usual_history_rows, "rows of the history");
      return true;
    }
    const auto steps = base_ ? whole_multiple(time_.end, *base_) : std::nullopt;
    const Real nearest = nearest_interval(steps, history.interval);
    if (fits_end)
      refuse(history, history, {time_.step_key, *base_}, nearest, base_);
    else
      refuse(history, end(), history, nearest, base_);
    return false;
  }

  void check_snapshots() {
    if (!entry_.is_sound("snapshot_interval")) return;
    const Clock snapshot{"snapshot_interval", time_.snapshot_interval};
    const bool fits_end = whole_multiple(time_.end, snapshot.interval).has_value();
    const bool fits_history = !history_ || whole_multiple(snapshot.interval, time_.history_interval).has_value();
    if (fits_end && fits_history) {
      warn_of_many(snapshot, most_snapshots, usual_snapshots, "snapshots");
      return;
    }
    const Real nearest = nearest_interval(rows(), snapshot.interval);
    const auto beneath = history_ ? std::optional(time_.history_interval) : base_;
    if (fits_end)
      refuse(snapshot, snapshot, {"history_interval", time_.history_interval}, nearest, beneath);
    else
      refuse(snapshot, end(), snapshot, nearest, beneath);
  }

  /// An end in another unit than the intervals, or one that has been forgotten.
  void warn_of_many(const Clock& clock, std::int64_t most, std::int64_t usual, std::string_view what) {
    const Real count = time_.end / clock.interval;
    if (count <= static_cast<Real>(most)) return;
    context_.problems.warning(
        entry_.place(clock.name), fmt::format("to end = {} s there will be {:.0f} {}", short_number(time_.end), count, what),
        fmt::format("{} = {} gives {}; is end in s?", clock.name, number_text(whole_fraction(time_.end, usual)), usual));
  }

  /// The interval nearest to the given one that divides the end, into parts that `shorter` (a number of
  /// shorter intervals in the run) allows.
  Real nearest_interval(std::optional<std::int64_t> shorter, Real given) const {
    if (!shorter) return nearest_fraction(time_.end, given);
    return whole_fraction(time_.end, nearest_divisor_by_length(*shorter, time_.end / given));
  }

  std::optional<std::int64_t> rows() const { return history_ ? whole_multiple(time_.end, time_.history_interval) : std::nullopt; }

  Clock end() const { return {"end", time_.end}; }

  const CheckContext& context_;
  const Entry& entry_;
  Clocks time_;
  std::optional<Real> base_;  // given, and the end is a whole number of it
  bool history_ = false;      // the end is a whole number of history intervals
};

}  // namespace

void resolve_clocks(const CheckContext& context, const Clocks& clocks) {
  const Entry entry = context.entries_of("time").front();
  if (entry.gives("end")) ClockCheck(context, entry, clocks).run();
}

void resolve_clocks(const CheckContext& context, UniformTime& time) {
  resolve_clocks(context, {time.end, "step", time.step, time.history_interval, time.snapshot_interval});
}

}  // namespace sazare::cases
