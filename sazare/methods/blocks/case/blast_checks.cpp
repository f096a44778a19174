#include <fmt/format.h>

#include <vector>

#include "sazare/cases/format/number_text.hpp"
#include "sazare/methods/blocks/case/checks.hpp"
#include "sazare/methods/blocks/case/pressure_table.hpp"

namespace sazare::cases {
namespace {

void check_pulse(const CheckContext& context, const Entry& entry) {
  for (std::string_view key : {"peak_pressure", "rise_time", "decay_ratio"}) {
    if (!entry.has(key))
      context.problems.error(entry.header(), fmt::format("[[blasts]] has no \"{}\"", key),
                             "add peak_pressure, rise_time and decay_ratio for a pulse, or table = \"file.csv\"");
  }
}

/// `chosen` gives the pressure, so nothing else does.
void check_nothing_besides(const CheckContext& context, const Entry& entry, std::string_view chosen) {
  for (std::string_view key : {"peak_pressure", "rise_time", "decay_ratio"}) {
    if (!entry.has(key)) continue;
    context.problems.error(*entry.value->key_place(key), fmt::format("the blast has both a {} and {}", chosen, key),
                           fmt::format("keep either the {}, or peak_pressure, rise_time and decay_ratio", chosen));
  }
}

void check_table(const CheckContext& context, const Entry& entry, PressureTable& table) {
  check_nothing_besides(context, entry, "table");
  if (entry.has("function"))
    context.problems.error(*entry.value->key_place("function"), "the blast has both a table and function", "keep one of the two");
  if (!entry.is_sound("table")) return;
  const std::string as_written = *entry.value->find("table")->text();
  if (!check_file(context, entry.place("table"), "pressure table", table.file, as_written)) return;
  const std::string shown = (context.shown_folder / as_written).lexically_normal().string();
  read_pressure_table(table, shown, entry.place("table"), context.problems);
}

}  // namespace

void check_blasts(const CheckContext& context, BlocksCase& blocks) {
  const auto list = context.entries_of("blasts");
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].exists()) continue;
    if (list[i].has("table"))
      check_table(context, list[i], std::get<PressureTable>(blocks.blasts[i].pressure));
    else if (std::holds_alternative<PressureFunction>(blocks.blasts[i].pressure))
      check_nothing_besides(context, list[i], "function");
    else
      check_pulse(context, list[i]);
    for (std::size_t other = 0; other < i; ++other)
      if (list[i].gives("surface") && blocks.blasts[other].surface == blocks.blasts[i].surface)
        context.problems.warning(
            list[i].place("surface"),
            fmt::format("two blasts act on the surface \"{}\": their pressures add up", blocks.blasts[i].surface),
            "give each hole a physical group of its own, or leave one blast out if that is not meant");
    const bool never = blocks.time.end > 0 && list[i].gives("delay") && blocks.blasts[i].delay >= blocks.time.end;
    if (never)
      context.problems.warning(list[i].place("delay"),
                               fmt::format("the blast begins at {} s, after the end of the run at {} s",
                                           short_number(blocks.blasts[i].delay), short_number(blocks.time.end)),
                               "choose a later end in [time], or remove the blast; delays are in s");
  }
}

}  // namespace sazare::cases
