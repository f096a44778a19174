#pragma once

/// A pressure history given by points: straight lines between them, nothing before the first and after the last.

#include <algorithm>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct PressureTable {
  std::vector<Real> time;      ///< [s], strictly rising
  std::vector<Real> pressure;  ///< [Pa]
};

inline Real table_pressure(const PressureTable& table, Real time) {
  if (table.time.empty() || time < table.time.front() || time > table.time.back()) return 0;
  const auto above = std::upper_bound(table.time.begin(), table.time.end(), time);
  if (above == table.time.end()) return table.pressure.back();
  const auto i = static_cast<std::size_t>(above - table.time.begin());
  const Real share = (time - table.time[i - 1]) / (table.time[i] - table.time[i - 1]);
  return table.pressure[i - 1] + share * (table.pressure[i] - table.pressure[i - 1]);
}

}  // namespace sazare::laws
