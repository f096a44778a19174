#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/number_text.hpp"
#include "sazare/cases/pressure_table.hpp"
#include "sazare/cases/suggest.hpp"

namespace sazare::cases {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_beside(const fs::path& file) {
  std::vector<std::string> names;
  std::error_code failure;
  for (auto entry = fs::directory_iterator(file.parent_path(), failure); !failure && entry != fs::directory_iterator();
       entry.increment(failure)) {
    const bool same_kind = entry->path().extension() == file.extension();
    if (same_kind && entry->is_regular_file(failure)) names.push_back(entry->path().filename());
  }
  std::ranges::sort(names);
  return names;
}

void report_missing_file(const CheckContext& context, const Place& place, std::string_view what, const fs::path& file,
                         const std::string& as_written) {
  std::error_code failure;
  if (fs::exists(file, failure)) {
    context.problems.error(place, fmt::format("{} is not a file: {}", what, as_written), "name a file");
    return;
  }
  const auto shown = (context.shown_folder / as_written).lexically_normal().string();
  const auto others = files_beside(file);
  const std::string other_files =
      others.empty() ? "" : fmt::format("; {}", suggestion(file.filename().string(), others, "files there"));
  context.problems.error(place, fmt::format("{} not found: {}", what, as_written),
                         fmt::format("paths are relative to the case file; looked for {}{}", shown, other_files));
}

bool is_file(const fs::path& file) {
  std::error_code failure;
  return fs::is_regular_file(file, failure);
}

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
  if (!is_file(table.file)) {
    report_missing_file(context, entry.place("table"), "pressure table", table.file, as_written);
    return;
  }
  const std::string shown = (context.shown_folder / as_written).lexically_normal().string();
  read_pressure_table(table, shown, entry.place("table"), context.problems);
}

}  // namespace

bool check_file(const CheckContext& context, const Place& place, std::string_view what, const fs::path& file,
                const std::string& as_written) {
  if (is_file(file)) return true;
  report_missing_file(context, place, what, file, as_written);
  return false;
}

void check_mesh_file(const CheckContext& context, const Mesh& mesh) {
  const Entry entry = context.entries_of("mesh").front();
  if (!entry.gives("file")) return;
  const std::string& as_written = *entry.value->find("file")->text();
  const std::string kind = mesh.file.extension().string();
  if (kind != ".msh" && kind != ".geo") {
    context.problems.error(entry.place("file"), fmt::format("{} is neither a .msh nor a .geo file", as_written),
                           "save the mesh by Gmsh as .msh, format 4.1, or name the geometry (.geo)");
    return;
  }
  if (!is_file(mesh.file)) report_missing_file(context, entry.place("file"), "mesh file", mesh.file, as_written);
  for (std::string_view key : {"size_factor", "parameters"}) {
    if (mesh.is_geometry() || !entry.has(key)) continue;
    context.problems.error(*entry.value->key_place(key), fmt::format("{} is only for a .geo file", key),
                           fmt::format("remove it: {} is meshed already", as_written));
  }
}

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
    const bool never = blocks.time.end > 0 && list[i].gives("delay") && blocks.blasts[i].delay >= blocks.time.end;
    if (never)
      context.problems.warning(list[i].place("delay"),
                               fmt::format("the blast begins at {} s, after the end of the run at {} s",
                                           short_number(blocks.blasts[i].delay), short_number(blocks.time.end)),
                               "choose a later end in [time], or remove the blast");
  }
}

}  // namespace sazare::cases
