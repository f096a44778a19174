#pragma once

/// Columns of tables that runs of several methods write, in their order. Those of a method stand in its own columns.hpp; the
/// reference (folder_page.cpp) prints all. Energies and forces in the plane are per metre across it.

#include "sazare/observe/column.hpp"

namespace sazare::runs::columns {

using observe::Column;

inline constexpr std::array time = {Column{"time", "s", "since the beginning"}};
inline constexpr std::array clock = {Column{"wall_seconds", "s", "wall-clock time since the run began"}};

/// Columns of gauges.
inline constexpr std::array place_motion = {Column{"NAME.displacement", "m", "since the beginning", 3},
                                            Column{"NAME.velocity", "m/s", "", 3}, Column{"NAME.acceleration", "m/s2", "", 3}};

inline constexpr std::array fragments = {
    Column{"fragment", "-", "number, as in the snapshots"},
    Column{"elements", "-", "number of elements; of bonded bodies: of spheres"},
    Column{"volume", "m3", ""},
    Column{"mass", "kg", ""},
    Column{"size", "m", "diameter of the sphere of the same volume"},
    Column{"center", "m", "of mass", 3},
    Column{"velocity", "m/s", "of the centre", 3},
    Column{"throw", "m", "displacement of the centre; of bonded bodies: from the position given by the group"}};

inline constexpr std::array stays = {
    Column{"stays", "-", "method `blocks`: 1 where the fragment remains in place and no size distribution counts it"}};

inline constexpr std::array timing = {Column{"part", "", "of a step, or of the run"}, Column{"seconds", "s", ""},
                                      Column{"share", "-", "of the run"}};

}  // namespace sazare::runs::columns
