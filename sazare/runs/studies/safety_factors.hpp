#pragma once

#include <filesystem>
#include <memory>

#include "sazare/cases/study_file.hpp"
#include "sazare/runs/studies/run_study.hpp"
#include "sazare/runs/studies/study_search.hpp"

namespace sazare::runs {

/// The factor of safety of each case by strength reduction: the factor by which its strengths may be divided before the ground
/// does not stand under gravity. A trial has failed where the ground finds no equilibrium, or moves by so many times more than
/// the same ground does without a limit of strength. The factor is bisected between the bounds of the study.
///
/// The folder `trials` in that of the study has a table of the trials of each case, NUMBER.csv, and the ground at the end of the
/// last one that failed, NUMBER_slip.csv. The study and the options must outlive the search.
std::unique_ptr<StudySearch> safety_factors(const cases::Study& study, const StudyOptions& options);

}  // namespace sazare::runs
