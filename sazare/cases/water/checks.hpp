#pragma once

#include "sazare/cases/checks.hpp"
#include "sazare/cases/water/table.hpp"

namespace sazare::cases {

/// Checks [water] of a case, where it is there, and reads its table of waves.
void check_water(const CheckContext& context, Water& water, const Gravity& gravity);

/// Reads the table of waves. Problems are shown in that file under the name `shown_name` and listed where the case names it.
void read_water_record(Water& water, const std::string& shown_name, const Place& named_at, Problems& problems);

}  // namespace sazare::cases
