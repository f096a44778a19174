#pragma once

/// Carries out a case in a folder: from the beginning or from its checkpoint, to the end or until it is asked to stop.

#include <atomic>

#include "sazare/cases/case_file.hpp"
#include "sazare/engine/simulation.hpp"
#include "sazare/observe/manifest.hpp"
#include "sazare/runs/run_folder.hpp"

namespace sazare::runs {

struct RunOptions {
  std::filesystem::path folder;
  Begin begin = Begin::fresh;
  bool quiet = false;                              ///< no progress, no words about the beginning
  const std::atomic<bool>* stop_asked = nullptr;   ///< looked at after every base step
  engine::Sharing sharing = {};                    ///< with several processes: all carry out the same, the first one writes
};

struct RunOutcome {
  bool stopped = false;  ///< asked to, before its end; the checkpoint is written
  Real time = 0;         ///< simulated [s]
  observe::Manifest manifest;
};

/// Throws UserError, PhysicsError or MachineError; what was written until then can be resumed from the last checkpoint.
RunOutcome run_blocks(const cases::CaseFile& file, const RunOptions& options);

}  // namespace sazare::runs
