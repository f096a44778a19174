#include "sazare/methods/spheres/run/method.hpp"

#include <fmt/format.h>

#include "sazare/methods/spheres/case/format.hpp"
#include "sazare/methods/spheres/run/columns.hpp"
#include "sazare/methods/spheres/run/run.hpp"
#include "sazare/methods/spheres/run/sharing.hpp"
#include "sazare/runs/record_columns.hpp"
#include "sazare/runs/record_figures.hpp"
#include "sazare/runs/summary.hpp"

namespace sazare::runs {

namespace {

std::string spheres_summary(const observe::Manifest& manifest) {
  const auto number = [&](std::string_view name, int digits = 4) { return figure_text(manifest, name, digits); };
  std::string text;
  text += fmt::format("spheres         {}, {} contacts at the end, step {} s\n", number("particles", 12), number("contacts", 12),
             number("step"));
  if (figure(manifest, "bodies") > 0)
    text += fmt::format("bodies          {} bonded, {} of them broken, in {} pieces\n", number("bodies", 12), number("broken_bodies", 12),
               number("fragments", 12));
  text += fmt::format("energy          lost {} J, residual {} J; peak speed {} m/s\n", number("energy_lost"),
                      number("energy_residual", 2), number("peak_speed"));
  return text + wall_time_line(manifest, "particle_steps", "sphere-steps");
}

FolderTables tables_of_spheres() {
  return {.figures = {{"`spheres`", {figures::of_steps, figures::of_spheres, columns::spheres::figures}}},
          .history = {{"`spheres`", {columns::spheres::history}}},
          .gauges = {{"`gauges.csv` of `spheres`", {columns::spheres::gauge}}, {"`walls.csv`", {columns::spheres::wall}}},
          .files = {{"`ranks.csv` of `spheres`, a row per rank", {columns::spheres::ranks}}},
          .snapshots = {{"`particles` of `spheres`", {columns::spheres::particles}},
                        {"`walls` of `spheres`: triangles, once where no wall of them moves", {columns::spheres::surfaces}}}};
}

}  // namespace

Method spheres_method() {
  return {.format = cases::spheres_format(),
          .open = open_spheres,
          .check = check_spheres,
          .summary = spheres_summary,
          .tables = tables_of_spheres,
          .explain_ranks = explain_ranks_of_spheres};
}

}  // namespace sazare::runs
