#include "sazare/runs/summary.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sazare/cases/format/number_text.hpp"

namespace sazare::runs {

Real figure(const observe::Manifest& manifest, std::string_view name) {
  for (const auto& [key, value] : manifest.results)
    if (key == name) return std::visit([](auto number) { return static_cast<Real>(number); }, value);
  return 0;
}

std::string figure_text(const observe::Manifest& manifest, std::string_view name, int digits) {
  return cases::short_number(figure(manifest, name), digits);
}

std::string balance_text(const observe::Manifest& manifest) {
  const Real work = figure(manifest, "energy_work"), residual = figure(manifest, "energy_residual");
  const std::string share = work != 0 ? fmt::format(" ({:.1e} of the work)", std::abs(residual / work)) : "";
  return fmt::format("work {} J, residual {} J{}", cases::short_number(work, 4), cases::short_number(residual, 2), share);
}

std::string balance_warning(const observe::Manifest& manifest) {
  constexpr Real warned_of = 0.01;
  const Real work = figure(manifest, "energy_work"), share = std::abs(figure(manifest, "energy_residual") / work);
  if (work == 0 || share <= warned_of) return "";
  return fmt::format("warning: the energy balance misses {} % of the work, so that motion may have gained or lost energy by itself\n"
                     "      help: a smaller time.stability_fraction, or a smaller step, should bring it below 1 %; the report of the "
                     "run says more\n",
                     cases::short_number(100 * share, 2));
}

std::string wall_time_line(const observe::Manifest& manifest, std::string_view steps, std::string_view step_name) {
  const Real seconds = figure(manifest, "wall_seconds");
  std::string text = fmt::format("wall-clock time {:.2f} s", seconds);
  if (!steps.empty())
    text +=
        fmt::format(", {} {} per second", cases::short_number(seconds > 0 ? figure(manifest, steps) / seconds : 0, 3), step_name);
  return text + fmt::format(", {} thread{}\n", manifest.machine.threads, manifest.machine.threads == 1 ? "" : "s");
}

}  // namespace sazare::runs
