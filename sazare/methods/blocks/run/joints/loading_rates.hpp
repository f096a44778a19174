#pragma once

/// Rate laws of joints, see methods/blocks/strength_by_rate.hpp.

#include <vector>

#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/rates/joint_rates.hpp"

namespace sazare::runs {

/// The rate law of each entry of [[joints]]. `faces`, whose kind is the number of their entry and which have their springs, get
/// what they need to follow it: strain per opening by the Young's moduli of the two elements beside each, in series.
std::vector<laws::DynamicIncrease> add_loading_rates(const cases::BlocksCase& blocks, const std::vector<Index>& material,
                                                     std::vector<methods::blocks::JointFace>& faces);

}  // namespace sazare::runs
