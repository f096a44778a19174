#pragma once

#include <filesystem>

#include "sazare/core/vector.hpp"
#include "sazare/geometry/tetra_mesh.hpp"

namespace sazare::geometry {

/// Reads a Gmsh mesh, format 4.1, ASCII or binary, and checks it (see check_mesh).
///
/// Physical volume groups become regions, physical surface groups become surfaces; nodes that no tetrahedron
/// uses are dropped. `scale` multiplies the coordinates (file's unit to metres). Throws UserError, with the
/// file, the line or section and the element numbers, for anything that cannot be used.
TetraMesh read_gmsh(const std::filesystem::path& file, Real scale);

}  // namespace sazare::geometry
