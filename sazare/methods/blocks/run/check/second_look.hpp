#pragma once

#include <string>

#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::runs {

/// Lines of `check` about what a mesh and a case come to: size and mass, the holes of blasts, and what holds the body.
std::string second_look(const cases::BlocksCase& blocks, const BlocksModel& model);

}  // namespace sazare::runs
