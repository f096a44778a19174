#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "sazare/cases/case_file.hpp"
#include "sazare/cases/study_file.hpp"
#include "sazare/core/stop_request.hpp"
#include "sazare/runs/method.hpp"
#include "sazare/runs/run_folder.hpp"

namespace sazare::runs {

struct StudyOptions {
  std::filesystem::path folder;
  Begin begin = Begin::fresh;
  bool quiet = false;
  int threads = 1;                                ///< cases at a time
  StopRequest stop = {};                          ///< looked at before every case, and in long ones
};

struct StudyOutcome {
  std::size_t done = 0;
  std::size_t cases = 0;
  Real wall_seconds = 0;
  std::string summary;  ///< of a complete study, lines of text
};

/// What there is to read and search the cases of a study with.
struct StudyMethods {
  std::function<cases::CaseFile(const std::filesystem::path& path, std::span<const std::string> overrides)> read;
  std::span<const Method> methods;
};

/// Seeks in every case of a study what it asks for. study.csv has a row for each that is done; a stopped study goes on with the
/// others. Once all are done, rows stand in order. Throws UserError, MachineError.
StudyOutcome run_study(const cases::Study& study, const StudyOptions& options, const StudyMethods& methods);

}  // namespace sazare::runs
