#include "sazare/methods/blocks/run/method.hpp"

#include <fmt/format.h>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/blocks/case/format.hpp"
#include "sazare/methods/blocks/run/columns.hpp"
#include "sazare/methods/blocks/run/run.hpp"
#include "sazare/runs/record_columns.hpp"
#include "sazare/runs/summary.hpp"

namespace sazare::runs {

namespace {

/// Where deformable elements were strained by more than their law is for.
std::string strain_warning(const observe::Manifest& manifest) {
  constexpr Real warned_of = 0.1;
  if (!(figure(manifest, "peak_strain") > warned_of)) return "";
  return fmt::format(
      "warning: elements were strained by up to {}, and the elastic law of deformable elements is for small strains\n"
      "      help: check the loads and the strengths of joints; loose elements that ring need a bulk_damping_ratio\n",
      figure_text(manifest, "peak_strain", 2));
}

std::string blocks_summary(const observe::Manifest& manifest) {
  const auto number = [&](std::string_view name, int digits = 4) { return figure_text(manifest, name, digits); };
  std::string text;
  text += fmt::format("broken joints   {} of {}\n", number("broken_joints", 12), number("joints", 12));
  text += fmt::format("fragments       {} of {} elements, {} of them detached: {} m3\n", number("fragments", 12),
                      number("elements", 12), number("detached_fragments", 12), number("detached_volume", 3));
  if (figure(manifest, "detached_fragments") > 0)
    text += fmt::format("sizes           P20 {} m, P50 {} m, P80 {} m of the detached mass\n", number("p20", 3), number("p50", 3),
                        number("p80", 3));
  text += fmt::format("largest throw   {} m, peak speed {} m/s\n", number("throw_max"), number("peak_speed"));
  text += fmt::format("energy          {}\n", balance_text(manifest));
  text += strain_warning(manifest);
  text += fmt::format("wall-clock time {:.2f} s, {} pair evaluations, {} thread{}\n", figure(manifest, "wall_seconds"),
             number("pair_evaluations"), manifest.machine.threads, manifest.machine.threads == 1 ? "" : "s");
  return text;
}

FolderTables tables_of_blocks() {
  return {.figures = {{"`blocks`", {columns::blocks::figures}}},
          .history = {{"`blocks`",
                       {columns::blocks::pieces, columns::blocks::energies, columns::blocks::progress, columns::blocks::boundary,
                        columns::blocks::charge}}},
          .gauges = {{"`gauges.csv` of `blocks`", {columns::blocks::gauge}}},
          .files = {{"`gauge_peaks.csv`", {columns::blocks::gauge_peaks}},
                    {"`holes.csv`", {columns::blocks::holes}},
                    {"`half_casts.csv`", {columns::blocks::half_casts}},
                    {"`ranks.csv`, a row per rank and interval",
                     {columns::blocks::ranks, columns::blocks::rank_topic, columns::blocks::rank_level}}},
          .snapshots = {{"`elements` of `blocks`", {columns::blocks::elements}},
                        {"`joints` of `blocks`", {columns::blocks::joints, columns::blocks::natural_joints}}}};
}

}  // namespace

Method blocks_method() {
  return {.format = cases::blocks_format(),
          .open = open_blocks,
          .check = check_blocks,
          .summary = blocks_summary,
          .tables = tables_of_blocks,
          .explain_ranks = explain_ranks_of_blocks};
}

}  // namespace sazare::runs
