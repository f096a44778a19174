#pragma once

/// What a case's steps mean for its elements: who limits them, and whether they are stable.

#include <array>
#include <string>
#include <vector>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::runs {

/// Share of an element's own limit (its neighbours held, levels::stable_step) up to which steps are stable when the
/// neighbours move as well.
inline constexpr Real stable_share = 0.5;

/// An element with a small stable step.
struct LimitingElement {
  Index element = 0;
  Real stable_step = 0;  ///< largest with its neighbours held [s]
};

/// Whether an element's dashpots bind its step more than its springs.
inline bool bound_by_dashpots(const BlocksModel& model, Index element) {
  return model.is_bound_by_dashpots[static_cast<std::size_t>(element)];
}

/// The elements with the smallest stable steps, smallest first.
std::vector<LimitingElement> limiting_elements(const BlocksModel& model, std::size_t count);

/// How many elements take each level at the beginning, coarsest first. The simulation must have been started.
std::vector<Index> level_histogram(const BlocksModel& model);

/// Evaluations of joints per second of simulated time at the levels of the beginning.
Real evaluations_per_second(const BlocksModel& model);

/// A warning, ready to print, when the steps that the case asks for are above what is stable; empty when they are not.
/// Throws UserError instead where the case is strict.
std::string check_stability(const cases::CaseFile& file, const BlocksModel& model);

/// All warnings of a case with its mesh: what it holds for, and its steps.
std::string warn_of(const cases::CaseFile& file, const BlocksModel& model);

/// "element 12 at (1, 2, 3) m"
std::string element_text(const geometry::TetraMesh& mesh, Index element);

}  // namespace sazare::runs
