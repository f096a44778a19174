#pragma once

#include <filesystem>
#include <string>

#include "sazare/geometry/triangle.hpp"

namespace sazare::geometry {

/// Reads the triangles of an STL file (text or binary), or of a Gmsh mesh, format 4.1: those of the physical surface group, or
/// all where the group is empty. `scale` is the length of the file's unit [m]. Throws UserError, with the file and what is wrong
/// in it, for a file without triangles, and for triangles without area, which are listed.
std::vector<Triangle> read_surface(const std::filesystem::path& file, const std::string& group, Real scale);

}  // namespace sazare::geometry
