#include "sazare/methods/fem/run/method.hpp"

#include <fmt/format.h>

#include "sazare/methods/fem/case/format.hpp"
#include "sazare/methods/fem/run/columns.hpp"
#include "sazare/methods/fem/run/run.hpp"
#include "sazare/methods/fem/run/strength_reduction.hpp"
#include "sazare/runs/record_columns.hpp"
#include "sazare/runs/record_figures.hpp"
#include "sazare/runs/summary.hpp"

namespace sazare::runs {

namespace {

std::string fem_summary(const observe::Manifest& manifest) {
  const auto number = [&](std::string_view name, int digits = 4) { return figure_text(manifest, name, digits); };
  std::string text;
  text += fmt::format("elements        {}, {} degrees of freedom, {} steps of {} s\n", number("elements", 12),
                      number("degrees_of_freedom", 12), number("steps", 12), number("step"));
  text += fmt::format("solver          {} Newton iterations, {} step cuts\n", number("newton_iterations", 12),
                      number("step_cuts", 12));
  text += fmt::format("peaks           {} m, {} m/s, {} m/s2\n", number("peak_displacement"), number("peak_speed"),
             number("peak_acceleration"));
  text += fmt::format("energy          {}\n", balance_text(manifest));
  return text + wall_time_line(manifest);
}

FolderTables tables_of_fem() {
  return {.figures = {{"`fem`", {figures::of_steps, figures::of_nodes, columns::fem::figures}}},
          .history = {{"`fem`",
                       {columns::fem::motion, columns::fem::energies, columns::fem::work, columns::fem::boundary,
                        columns::fem::pore_water, columns::fem::moving_water, columns::fem::water, columns::fem::joint_set,
                        columns::fem::member, columns::fem::force_limit, columns::fem::moment_limit, columns::fem::newton}}},
          .gauges = {{"`gauges.csv` of `fem`", {columns::place_motion, columns::fem::gauge_pressure}}},
          .files = {},
          .snapshots = {{"`finite_elements` of `fem`, points", {columns::fem::nodes, columns::fem::yielded}},
                        {"cells", {columns::fem::elements, columns::fem::soil, columns::fem::pores, columns::fem::excess}}}};
}

}  // namespace

Method fem_method() {
  return {.format = cases::fem_format(),
          .open = open_fem,
          .check = check_fem,
          .summary = fem_summary,
          .tables = tables_of_fem,
          .reduce_strength = reduce_strength_of_fem};
}

}  // namespace sazare::runs
