#pragma once

#include <string>

#include "sazare/cases/format/problems.hpp"
#include "sazare/cases/tables.hpp"

namespace sazare::cases {

/// Reads the record of a motion, by the name of its file: CSV with the header `time [s],acceleration [m/s2]` (or velocity, or
/// displacement; units m/s2, g, gal, m/s, cm/s, m, cm; semicolons or tabs in the header separate the rows too), PEER NGA (.AT2),
/// K-NET and KiK-net ASCII (.EW .NS .UD, with 1 or 2). A file with another number of samples than its header announces is
/// refused. Fills in quantity and samples in SI units; the counts of a K-NET file stand about zero after its own mean is taken
/// off. Reports what is wrong with its place.
void read_motion_file(Motion& motion, const std::string& shown_name, const Place& named_at, Problems& problems);

}  // namespace sazare::cases
