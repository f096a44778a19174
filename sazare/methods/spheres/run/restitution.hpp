#pragma once

/// Whether the step gives the coefficients of restitution that the case asks for.

#include "sazare/methods/spheres/run/model.hpp"

namespace sazare::runs {

/// A warning where spheres may hit each other or a wall so fast that they rebound by more than 2 % otherwise than asked for, with
/// the speed up to which the step holds; "" where none may. Throws UserError instead where the case is strict.
std::string warn_of_restitution(const cases::CaseFile& file, const SpheresModel& model);

}  // namespace sazare::runs
