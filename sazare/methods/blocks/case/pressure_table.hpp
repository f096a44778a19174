#pragma once

#include <string>

#include "sazare/cases/format/problems.hpp"
#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::cases {

/// Reads `table.file`, CSV with header "time [s],pressure [Pa]". Problems are shown in the CSV file under the
/// name `shown_name` and listed where the case names the file.
void read_pressure_table(PressureTable& table, const std::string& shown_name, const Place& named_at, Problems& problems);

}  // namespace sazare::cases
