#include "sazare/runs/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
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

namespace {

/// Energy that loads have brought in and that the body had stored or in motion at the beginning and has given away.
Real energy_brought_in(const observe::Manifest& manifest) {
  const auto given_away = [&](std::string_view name) { return std::max(Real{0}, -figure(manifest, name)); };
  return std::abs(figure(manifest, "energy_work")) + given_away("energy_elastic") + given_away("energy_kinetic");
}

/// What a residual is a share of, in words.
std::string_view reference(const observe::Manifest& manifest) {
  return energy_brought_in(manifest) > std::abs(figure(manifest, "energy_work")) ? "the work and the energy set free"
                                                                                 : "the work";
}

bool tells(const observe::Manifest& manifest, std::string_view name) {
  return std::ranges::any_of(manifest.results, [&](const auto& result) { return result.first == name; });
}

/// Whether a body that has settled before the run has hardly moved since: what is left of its forces swings.
bool stays_settled(const observe::Manifest& manifest) {
  constexpr Real hardly = 1e-3;
  return tells(manifest, "settlement") && tells(manifest, "throw_max") &&
         figure(manifest, "throw_max") < hardly * figure(manifest, "settlement");
}

/// Nothing has moved by more than round-off, of which the balance then consists.
bool rests(const observe::Manifest& manifest) {
  constexpr Real round_off = 1e-12, slow = 1e-6, nothing = 1e-9;  // m; far less than an atom; m/s and J
  const Real noise = figure(manifest, "energy_round_off");
  if (noise > 0 && energy_brought_in(manifest) <= noise && std::abs(figure(manifest, "energy_residual")) <= noise) return true;
  if (tells(manifest, "peak_displacement")) return figure(manifest, "peak_displacement") < round_off;
  return tells(manifest, "peak_speed") && figure(manifest, "peak_speed") < slow && energy_brought_in(manifest) < nothing;
}

}  // namespace

std::string balance_text(const observe::Manifest& manifest) {
  const Real work = figure(manifest, "energy_work"), residual = figure(manifest, "energy_residual"),
             whole = energy_brought_in(manifest);
  const std::string share =
      whole > 0 && !rests(manifest) ? fmt::format(" ({:.1e} of {})", std::abs(residual / whole), reference(manifest)) : "";
  return fmt::format("work {} J, residual {} J{}", cases::short_number(work, 4), cases::short_number(residual, 2), share);
}

std::string balance_warning(const observe::Manifest& manifest) {
  constexpr Real warned_of = 0.01;
  if (rests(manifest)) return "";
  const Real whole = energy_brought_in(manifest), residual = std::abs(figure(manifest, "energy_residual")), share = residual / whole;
  const Real held = std::abs(figure(manifest, "energy_kinetic")) + std::abs(figure(manifest, "energy_elastic"));
  if (whole == 0 && residual > warned_of * held && !stays_settled(manifest))
    return fmt::format("warning: the bodies have an energy of {} J, though no work was done on them\n"
                       "      help: a load or a motion may have jumped within one step; let it grow over several\n",
                       cases::short_number(residual, 2));
  if (whole == 0 || share <= warned_of) return "";
  return fmt::format(
      "warning: the energy balance misses {} % of {}, so that motion may have gained or lost energy by itself\n"
      "      help: a smaller step, such as by time.stability_fraction where the method has it, should bring it below 1 %; the "
      "report "
      "of the run says more\n",
      cases::short_number(100 * share, 2), reference(manifest));
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
