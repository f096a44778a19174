#pragma once

/// Histories of the gauges of a case of method mps, in memory.

#include <string>
#include <vector>

#include "sazare/methods/mps/run/model.hpp"

namespace sazare::validation {

struct Trace {
  Real step = 0;                                ///< [s]
  std::vector<std::vector<Real>> displacement;  ///< by gauge and step, along the axis asked for [m]
  std::vector<std::vector<Real>> acceleration;  ///< [m/s2]
};

/// Runs a 2-D case to its end with all numbers at every `every`-th step along an axis.
Trace trace_gauges(const std::string& path, const std::vector<std::string>& overrides, std::size_t axis, int every = 1);

}  // namespace sazare::validation
