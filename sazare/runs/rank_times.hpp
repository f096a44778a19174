#pragma once

/// What every rank of a run had to do, interval by interval.

#include <filesystem>

#include "sazare/engine/simulation.hpp"

namespace sazare::runs {

class RankTimes {
 public:
  /// Writes ranks.csv: rows by interval between cuts and rank, times and bytes cumulated. Nothing when the process is alone.
  void write(const std::filesystem::path& file, engine::Simulation<3>& simulation);

 private:
  std::vector<engine::RankWork> work_;
};

}  // namespace sazare::runs
