#include "sazare/methods/rectangles/run/method.hpp"

#include <fmt/format.h>

#include "sazare/methods/rectangles/case/format.hpp"
#include "sazare/methods/rectangles/run/columns.hpp"
#include "sazare/methods/rectangles/run/run.hpp"
#include "sazare/runs/record_columns.hpp"
#include "sazare/runs/record_figures.hpp"
#include "sazare/runs/summary.hpp"

namespace sazare::runs {

namespace {

std::string rectangles_summary(const observe::Manifest& manifest) {
  const auto number = [&](std::string_view name, int digits = 4) { return figure_text(manifest, name, digits); };
  std::string text;
  text += fmt::format("elements        {}, step {} s, predicted limit {} s\n", number("elements", 12), number("step"),
             number("predicted_limit"));
  text += fmt::format("broken springs  {}, broken links {}\n", number("broken_springs", 12), number("broken_links", 12));
  text += fmt::format("peaks           {} m, {} m/s\n", number("peak_displacement"), number("peak_speed"));
  text += fmt::format("energy          {}\n", balance_text(manifest));
  return text + wall_time_line(manifest, "element_steps", "element-steps");
}

FolderTables tables_of_rectangles() {
  return {.figures = {{"`rectangles`", {figures::of_steps, figures::of_elements, columns::rectangles::figures}}},
          .history = {{"`rectangles`", {columns::rectangles::history, columns::rectangles::support}}},
          .gauges = {{"`gauges.csv` of `rectangles`", {columns::place_motion, columns::rectangles::gauge_rotation}}},
          .files = {},
          .snapshots = {{"`rectangles`", {columns::rectangles::elements}}}};
}

}  // namespace

Method rectangles_method() {
  return {.format = cases::rectangles_format(),
          .open = open_rectangles,
          .check = [](const cases::CaseFile& file) { return check_rectangles(file); },
          .summary = rectangles_summary,
          .tables = tables_of_rectangles};
}

}  // namespace sazare::runs
