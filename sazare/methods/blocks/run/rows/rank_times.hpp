#pragma once

/// What every rank of a run had to do, interval by interval.

#include <filesystem>

#include "sazare/levels/simulation.hpp"

namespace sazare::runs {

/// Writes ranks.csv: rows by interval between cuts and rank, times and bytes cumulated. Nothing when the process is alone.
void write_rank_times(const std::filesystem::path& file, levels::Simulation<3>& simulation);

}  // namespace sazare::runs
