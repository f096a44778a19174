#pragma once

#include <string>
#include <vector>

#include "sazare/methods/blocks/case/case.hpp"

namespace sazare::cases {

/// Lines that tell what a charge is: its place, its explosive with mass and energy, and when it fires.
std::vector<std::string> charge_lines(const Charge& charge, std::size_t place);

}  // namespace sazare::cases
