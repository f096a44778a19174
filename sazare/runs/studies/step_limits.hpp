#pragma once

#include <filesystem>
#include <memory>

#include "sazare/cases/study_file.hpp"
#include "sazare/runs/studies/study_search.hpp"

namespace sazare::runs {

/// The largest stable step of each case. Once all are found, regression.csv in the folder of the study has (14) to (16) for each
/// family, where the parameters are those of the paper: spacing, velocity and damping. The study must outlive the search.
std::unique_ptr<StudySearch> step_limits(const cases::Study& study, const std::filesystem::path& folder);

}  // namespace sazare::runs
