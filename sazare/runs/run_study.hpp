#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/study_file.hpp"
#include "sazare/runs/run_folder.hpp"
#include "sazare/runs/stability_limit.hpp"

namespace sazare::runs {

struct StudyOptions {
  std::filesystem::path folder;
  Begin begin = Begin::fresh;
  bool quiet = false;
  int threads = 1;                                ///< cases at a time
  const std::atomic<bool>* stop_asked = nullptr;  ///< looked at before every case
};

struct StudyOutcome {
  std::size_t done = 0;
  std::size_t cases = 0;
  Real largest_difference = 0;  ///< of prediction and bisection, |ln|
  Real wall_seconds = 0;
};

/// How the cases of a study are read, and how the limit of one is sought.
struct LimitSeeker {
  std::function<cases::CaseFile(const std::filesystem::path& path, std::span<const std::string> overrides)> read;
  std::function<FoundLimit(const cases::CaseFile& file, const LimitRules& rules)> find;
};

/// Seeks the limit of every case of a study. study.csv has a row for each that is done; a stopped study goes on with the others.
/// Once all are done, rows stand in order, and regression.csv has (14) to (16) for each family where the parameters are those of
/// the paper: spacing, velocity and damping. Throws UserError, MachineError.
StudyOutcome run_study(const cases::Study& study, const StudyOptions& options, const LimitSeeker& seeker);

}  // namespace sazare::runs
