#include "sazare/runs/folder_page.hpp"

#include <fmt/format.h>

#include "sazare/runs/record_columns.hpp"
#include "sazare/runs/record_figures.hpp"

namespace sazare::runs {

namespace {

using Columns = std::span<const observe::Column>;

constexpr const char* head = R"(# The folder of a run

Everything that a run writes, in SI units. A column's name ends with its unit, as in `time [s]`; `-` is a number without one, and in
the plane energies and forces are per metre across it. `NAME` stands for what the case calls a gauge, a wall, a motion or a group.
`sazare.open(FOLDER)` reads all of it. This page is written from the tables that the program writes by: `sazare schema --folder`.

| file | what is in it |
|---|---|
| `case.toml` | the case as it was run, with all defaults ([keys](case.md)) |
| `manifest.json` | what was run, on what, and the headline figures |
| `history.csv` | a row per `history_interval`: energies and extremes of the whole body |
| `gauges.csv` | the same clock, for each `[[gauges]]` |
| `walls.csv` | method `spheres`: forces and moments on walls |
| `fragments.csv` | method `blocks`: the fragments at the end; `spheres`: the pieces of bonded bodies |
| `timing.csv`, `ranks.csv` | where the time went: by part of a step; with several processes, by rank |
| `snapshots/*.vtkhdf` | places and fields per `snapshot_interval`; ParaView 5.11 or newer and pyvista open them |
| `mesh.msh` | of a case that names a geometry: the mesh that Gmsh made of it |
| `checkpoint/state.h5` | while the run is under way: what `--resume` goes on from |
| `report.html`, `report/` | made by `sazare report` |
| `continuum/`, `bodies/` | method `hybrid`: the folder of each side |

Files are written beside their place and moved there when they are whole, or grow row by row: what stands under its name can be read,
also after a crash. What two programs exchange stands [on a page of its own](coupling-files.md).

## manifest.json

`sazare`, `commit` (of the program), `case` (title), `method`, `status` (`running`, `done`, `stopped`, `failed`), `started` and
`finished` (UTC), `machine` (`cpu`, `cores`, `threads`, `ranks`), `state_hash` (of all that moves: equal hashes, equal bits), and
`results`: the energies of the history at the end, and
)";

constexpr const char* snapshots_head = R"(
## Snapshots

A series of files, one per time, `SERIES_00000.vtkhdf` and on, listed in `SERIES.vtkhdf.series`, with these fields of the cells, or
of the points where the table says so.
)";

std::string name_of(const observe::Column& column) {
  if (column.axes == 0) return fmt::format("`{}`", column.name);
  return fmt::format("`{}_x`, `_y`{}", column.name, column.axes > 2 ? ", `_z`" : "");
}

void add_table(std::string& page, std::string_view of, std::string_view what, const std::vector<ColumnGroup>& groups) {
  page += fmt::format("\n| {} | {} | unit | |\n|---|---|---|---|\n", of, what);
  for (const ColumnGroup& group : groups) {
    std::string_view owner = group.of;
    for (const Columns columns : group.columns)
      for (const observe::Column& column : columns) {
        page += fmt::format("| {} | {} | {} | {} |\n", owner, name_of(column), column.unit, column.meaning);
        owner = "";
      }
  }
}

/// The rows of all methods after those that they share.
std::vector<ColumnGroup> joined(std::vector<ColumnGroup> shared, std::span<const FolderTables> methods,
                                std::vector<ColumnGroup> FolderTables::*part) {
  for (const FolderTables& method : methods) shared.insert(shared.end(), (method.*part).begin(), (method.*part).end());
  return shared;
}

}  // namespace

std::string folder_markdown(std::span<const FolderTables> methods) {
  std::string page = head;
  add_table(page, "method", "figure", joined({{"all", {figures::of_all}}}, methods, &FolderTables::figures));
  page += "\n## history.csv\n";
  add_table(page, "method", "column", joined({{"all", {columns::time, columns::clock}}}, methods, &FolderTables::history));
  page += "\n## gauges.csv, walls.csv\n";
  add_table(page, "file", "column", joined({{"both", {columns::time}}}, methods, &FolderTables::gauges));
  page += "\n## fragments.csv, timing.csv, ranks.csv\n";
  add_table(page, "file", "column",
            joined({{"`fragments.csv`", {columns::fragments}}, {"`timing.csv`", {columns::timing}}}, methods, &FolderTables::files));
  page += snapshots_head;
  add_table(page, "series", "field", joined({}, methods, &FolderTables::snapshots));
  return page;
}

}  // namespace sazare::runs
