#pragma once

/// A run of method spheres on several processes.

#include <filesystem>
#include <string>
#include <vector>

#include "sazare/levels/simulation.hpp"
#include "sazare/methods/spheres/run/model.hpp"
#include "sazare/parallel/ranks.hpp"

namespace sazare::runs {

/// Lets the processes of a launch share the spheres.
void share_among(SpheresModel& model, const levels::Sharing& sharing);

/// What one process did so far.
struct SphereRankWork {
  std::int64_t rank = 0;
  Real seconds = 0;                ///< processor time of forces and motion [s]
  std::int64_t spheres = 0;        ///< for which it works now
  std::int64_t shown = 0;          ///< of these, those that others need at every step, each counted for each of them
  parallel::Traffic traffic;       ///< since the run began
  parallel::Sent expected_motion;  ///< about spheres at the borders, by the lists of ghosts
};

/// The work of all processes, in the first one; all call it.
std::vector<SphereRankWork> gather_rank_work(const SpheresModel& model);

/// Writes ranks.csv.
void write_rank_times(const std::filesystem::path& file, Real time, const std::vector<SphereRankWork>& work);

/// How so many processes would share a case.
std::string explain_ranks_of_spheres(const cases::CaseFile& file, int ranks);

}  // namespace sazare::runs
