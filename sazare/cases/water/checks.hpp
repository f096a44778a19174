#pragma once

#include <array>

#include "sazare/cases/checks.hpp"
#include "sazare/cases/water/table.hpp"

namespace sazare::cases {

/// Checks [water] of a case that ends at a time [s], where it is there, and reads its table of waves.
void check_water(const CheckContext& context, Water& water, const Gravity& gravity, Real end);

/// Waves must fit the sides of a periodic domain; lengths by axis, 0 where it is not periodic [m].
void check_periodic_waves(const CheckContext& context, const Water& water, const Gravity& gravity,
                          const std::array<Real, 3>& lengths);

/// Reads the table of waves. Problems are shown in that file under the name `shown_name` and listed where the case names it.
void read_water_record(Water& water, const std::string& shown_name, const Place& named_at, Problems& problems);

}  // namespace sazare::cases
