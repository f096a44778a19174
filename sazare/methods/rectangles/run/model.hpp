#pragma once

/// From a checked case of method rectangles to elements that can be stepped.

#include <memory>
#include <optional>
#include <string>

#include "sazare/methods/rectangles/run/assembly.hpp"
#include "sazare/methods/rectangles/stable_step.hpp"
#include "sazare/particles/uniform_stepper.hpp"

namespace sazare::runs {

struct RectanglesModel {
  Index elements = 0;                     ///< supports stand after them
  std::vector<Index> case_block;          ///< of the case, by block
  methods::rectangles::StableStep limit;  ///< predicted
  Real step = 0;                          ///< [s]
  std::string warning;                    ///< about the step, ready to print; empty when there is none
  std::unique_ptr<particles::UniformStepper<2>> stepper;
  methods::rectangles::RectangleForces* forces = nullptr;  ///< of the stepper
};

/// Builds the model and chooses the step. Throws UserError when the case is inconsistent, or its step is above the predicted limit.
/// With the windows of a coupling, whose surface elements may meet, a step that the case does not give divides them too [s].
RectanglesModel build_rectangles(const cases::CaseFile& file, std::optional<Real> window = std::nullopt);

/// Hash of the positions of the elements.
std::string assembly_hash(const state::Particles<2>& particles);

}  // namespace sazare::runs
