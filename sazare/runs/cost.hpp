#pragma once

#include <string>

#include "sazare/runs/run_clocks.hpp"

namespace sazare::runs {

/// What a run comes to, from figures that were measured once (docs/develop/performance.md): an estimate within a factor of two or
/// so.
struct Cost {
  Real work = 0;             ///< evaluations or steps of bodies in all
  Real work_per_second = 0;  ///< on one core
  Real columns = 0;          ///< of all tables of the run
  Real bodies = 0;           ///< in a snapshot
  Real bytes_of_body = 0;    ///< in a snapshot
};

/// A line of `check`: time on one core and size of the files.
std::string cost_text(const Cost& cost, const RunClocks& clocks);

}  // namespace sazare::runs
