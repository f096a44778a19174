#pragma once

/// How fast waves run through the elements of a case.

#include <string>

#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::runs {

/// Lines for each material: speeds of P and S waves; where the stiffness of joints is given per area, how they spread over the
/// mesh.
std::string describe_waves(const cases::BlocksCase& blocks, const BlocksModel& model);

}  // namespace sazare::runs
