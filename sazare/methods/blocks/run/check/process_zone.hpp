#pragma once

/// Elements against the process zones of cracks.

#include <string>

#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::runs {

/// A line for each entry of [[joints]] that breaks: the characteristic length E G/s_t^2, about that of the process zone ahead of
/// a crack (Hillerborg, Modeer and Petersson 1976), the shortest of its faces, beside the longest edge of the elements there.
/// Nothing where the springs stand for no elastic body.
std::string describe_process_zones(const cases::BlocksCase& blocks, const BlocksModel& model);

}  // namespace sazare::runs
