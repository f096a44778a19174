#pragma once

#include <string>
#include <vector>

#include "sazare/cases/format/problems.hpp"
#include "sazare/geometry/plane/polygon.hpp"
#include "sazare/methods/rectangles/case/case.hpp"

namespace sazare::cases {

/// A rectangle or polygon before it is turned, counter-clockwise [m].
std::vector<geometry::Vector2> outline_of(const SquareBlock& block);

/// Reads the places of the nuclei of a block of polygons. What is wrong is reported with its line: no numbers, places outside the
/// block, two at the same place, fewer than two.
void read_nuclei(SquareBlock& block, const std::string& shown_name, const Place& named_at, Problems& problems);

}  // namespace sazare::cases
