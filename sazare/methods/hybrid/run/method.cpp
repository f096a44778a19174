#include "sazare/methods/hybrid/run/method.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sazare/cases/format/counted.hpp"
#include "sazare/cases/format/number_text.hpp"
#include "sazare/core/saturated.hpp"
#include "sazare/methods/hybrid/case/format.hpp"
#include "sazare/methods/hybrid/run/columns.hpp"
#include "sazare/methods/hybrid/run/run.hpp"
#include "sazare/runs/record_columns.hpp"
#include "sazare/runs/summary.hpp"

namespace sazare::runs {

namespace {

std::string counted(const observe::Manifest& manifest, std::string_view name, std::string_view things) {
  return cases::counted(saturated<std::int64_t>(figure(manifest, name)), things);
}

bool tells(const observe::Manifest& manifest, std::string_view name) {
  return std::ranges::any_of(manifest.results, [&](const auto& result) { return result.first == name; });
}

/// A side that another program runs is not in the manifest of this one.
std::string continuum_text(const observe::Manifest& manifest) {
  return tells(manifest, "elements") ? counted(manifest, "elements", "finite elements") : "a continuum in another program";
}

std::string bodies_text(const observe::Manifest& manifest) {
  for (const auto& [name, words] : {std::pair{"particles", "spheres"},
                                    {"body_elements", "rectangles"},
                                    {"blocks", "blocks"},
                                    {"ground_particles", "particles of ground"}})
    if (tells(manifest, name)) return counted(manifest, name, words);
  return "bodies in another program";
}

std::string hybrid_summary(const observe::Manifest& manifest) {
  const auto number = [&](std::string_view name, int digits = 4) { return figure_text(manifest, name, digits); };
  std::string text;
  text += fmt::format("model           {} coupled with {}\n", continuum_text(manifest), bodies_text(manifest));
  text += fmt::format("coupling        {} of {} s, {} passes in all\n", counted(manifest, "windows", "windows"), number("window"),
                      number("passes", 12));
  text += fmt::format("surface         force up to {} N, displacement up to {} m\n", number("peak_force"),
                      number("peak_displacement"));
  text += fmt::format("energy          {} J over the surface, {} J added by the coupling, residual {} J\n",
                      number("energy_work_on_nodes"), number("energy_coupling_error", 2), number("energy_residual", 2));
  return text + wall_time_line(manifest);
}

FolderTables tables_of_hybrid() {
  return {.figures = {{"`hybrid`", {columns::hybrid::figures}}, {"`--side` of `hybrid`", {columns::hybrid::exchange}}},
          .history = {{"`hybrid`", {columns::hybrid::history}}},
          .gauges = {},
          .files = {},
          .snapshots = {}};
}

}  // namespace

Method hybrid_method() {
  return {.format = cases::hybrid_format(),
          .open = open_hybrid,
          .check = check_hybrid,
          .summary = hybrid_summary,
          .tables = tables_of_hybrid};
}

}  // namespace sazare::runs
