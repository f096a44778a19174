#include "sazare/methods/mps/run/method.hpp"

#include <fmt/format.h>

#include "sazare/methods/mps/case/format.hpp"
#include "sazare/methods/mps/run/columns.hpp"
#include "sazare/methods/mps/run/limit_search.hpp"
#include "sazare/methods/mps/run/run.hpp"
#include "sazare/methods/mps/run/strength_reduction.hpp"
#include "sazare/runs/record_columns.hpp"
#include "sazare/runs/record_figures.hpp"
#include "sazare/runs/summary.hpp"

namespace sazare::runs {

namespace {

// Of unbroken ground: plastic strains are added up, which is exact for small ones only.
constexpr Real largest_shear_strain = 0.3;

std::string mps_summary(const observe::Manifest& manifest) {
  const auto number = [&](std::string_view name, int digits = 4) { return figure_text(manifest, name, digits); };
  std::string text;
  text += fmt::format("particles       {}, step {} s, predicted limit {} s\n", number("particles", 12), number("step"),
             number("predicted_limit"));
  text += fmt::format("peaks           {} m, {} m/s, {} m/s2\n", number("peak_displacement"), number("peak_speed"),
             number("peak_acceleration"));
  if (figure(manifest, "unbroken_shear_strain") > largest_shear_strain)
    text += fmt::format(
        "shear           ground has sheared by {} without breaking; above {} it is too weak, and loses volume: let it "
        "break before (rupture_strain)\n",
        number("unbroken_shear_strain", 3), largest_shear_strain);
  return text + wall_time_line(manifest, "particle_steps", "particle-steps");
}

FolderTables tables_of_mps() {
  return {.figures = {{"`mps`", {figures::of_steps, figures::of_particles, columns::mps::figures}}},
          .history = {{"`mps`", {columns::mps::motion}},
                      {"`mps`, not with Euler's step", {columns::mps::energy_balance}},
                      {"`mps`, ground that fails", {columns::mps::failure}},
                      {"`mps`, in a hybrid case", {columns::mps::surface}}},
          .gauges = {{"`gauges.csv` of `mps`", {columns::place_motion}}},
          .files = {},
          .snapshots = {{"`particles` of `mps`", {columns::mps::particles, columns::mps::tensors}},
                        {"of ground that fails also", {columns::mps::failed_particles, columns::mps::degraded_particles}}}};
}

}  // namespace

Method mps_method() {
  return {.format = cases::mps_format(),
          .open = open_mps,
          .check = [](const cases::CaseFile& file) { return check_mps(file); },
          .summary = mps_summary,
          .tables = tables_of_mps,
          .find_limit = find_limit,
          .reduce_strength = reduce_strength_of_mps};
}

}  // namespace sazare::runs
