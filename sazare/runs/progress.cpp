#include "sazare/runs/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/saturated.hpp"

namespace sazare::runs {

namespace {

constexpr auto bar_interval = std::chrono::milliseconds(100);
constexpr auto line_interval = std::chrono::seconds(5);
constexpr int bar_width = 24;

std::string bar(Real share) {
  const int filled = std::clamp(saturated<int>(share * bar_width), 0, bar_width);
  return fmt::format("[{:#<{}}{:.<{}}]", "", filled, "", bar_width - filled);
}

}  // namespace

std::string duration_text(Real seconds) {
  const auto whole = saturated<std::int64_t>(std::round(std::max(seconds, Real{0})));
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

std::string progress_text(const ProgressState& first, const ProgressState& now, Real seconds) {
  const Real done = now.share - first.share;
  const Real rate = seconds > 0 ? static_cast<Real>(now.pair_evaluations - first.pair_evaluations) / seconds : 0;
  const std::string left = done > 0 ? duration_text(seconds * (1 - now.share) / done) + " left" : "time left unknown";
  const std::string broken = now.broken_joints < 0 ? "" : fmt::format("  {} broken joints", now.broken_joints);
  return fmt::format("{:3.0f} %  t = {} s  {}  {:.1e} {}/s  {} {} s{}", std::floor(100 * now.share),
                     cases::short_number(now.time, 4), left, rate, now.evaluated,
                     now.broken_joints < 0 ? "step" : "smallest step", cases::short_number(now.smallest_step, 3), broken);
}

Progress::Progress(bool quiet, const ProgressState& first)
    : quiet_(quiet),
      terminal_(isatty(STDOUT_FILENO) != 0),
      first_(first),
      next_(start_ + (terminal_ ? Clock::duration(bar_interval) : Clock::duration(line_interval))) {}

Progress::~Progress() { clear(); }

void Progress::show(const ProgressState& now) {
  const Clock::time_point at = Clock::now();
  const std::string text = progress_text(first_, now, std::chrono::duration<Real>(at - start_).count());
  if (terminal_)
    fmt::print("\r\033[K{} {}", bar(now.share), text);
  else
    fmt::print("{}\n", text);
  std::fflush(stdout);
  shown_ = true;
  next_ = at + (terminal_ ? Clock::duration(bar_interval) : Clock::duration(line_interval));
}

void Progress::clear() {
  if (!shown_ || !terminal_) return;
  fmt::print("\r\033[K");
  std::fflush(stdout);
  shown_ = false;
}

}  // namespace sazare::runs
