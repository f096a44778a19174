#pragma once

/// How a case is to be carried out, and what comes of it: the same for every method.

#include <filesystem>
#include <optional>

#include "sazare/core/stop_request.hpp"
#include "sazare/coupling/message.hpp"
#include "sazare/levels/simulation.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/runs/run_folder.hpp"

namespace sazare::runs {

/// One side of a hybrid case alone, with a partner in another program.
struct OneSide {
  coupling::Side side = coupling::Side::continuum;
  std::filesystem::path folder;  ///< of the exchange
  Real time_out = 600;           ///< how long to wait for the partner [s]
};

struct RunOptions {
  std::filesystem::path folder;
  Begin begin = Begin::fresh;
  bool quiet = false;                             ///< no progress, no words about the beginning
  StopRequest stop = {};                          ///< looked at after every base step
  levels::Sharing sharing = {};                   ///< with several processes: all carry out the same, the first one writes
  std::optional<OneSide> one_side = {};           ///< of a hybrid case; else both in this program
  bool warns = true;                              ///< of what is unusual in the case
  bool takes_forces = false;                      ///< whether forces will be given from outside, see LiveRun::apply
};

struct RunOutcome {
  bool stopped = false;  ///< asked to, before its end
  bool begun = true;     ///< only then has a stopped run a checkpoint
  Real time = 0;         ///< simulated [s]
  observe::Manifest manifest;
};

}  // namespace sazare::runs
