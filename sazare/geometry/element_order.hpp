#pragma once

#include "sazare/geometry/tetra_mesh.hpp"

namespace sazare::geometry {

/// Puts elements that are near in space near in memory: along a Morton curve through their centres. The elements keep
/// their tags, by which files and messages name them.
void sort_along_curve(TetraMesh& mesh);

}  // namespace sazare::geometry
