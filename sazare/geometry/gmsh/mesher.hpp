#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::geometry {

/// What to ask of the program gmsh.
struct MeshRequest {
  std::filesystem::path geometry;                             ///< the .geo file
  std::filesystem::path mesh;                                 ///< the .msh file to write (format 4.1, binary)
  std::vector<std::pair<std::string, Real>> parameters = {};  ///< names set in the .geo by DefineConstant
  Real size_factor = 1;                                       ///< factor on all element sizes, > 0 [-]
  int dimension = 3;                                          ///< up to which it is meshed
  std::string program = "gmsh";                               ///< looked up in PATH unless it holds a slash
};

/// Meshes a .geo by the program gmsh with one thread and a fixed seed: the same request gives the same mesh.
///
/// The mesh is written to a temporary name beside `request.mesh` and renamed when gmsh has succeeded.
/// Throws UserError when gmsh is not installed or fails (with its own last messages), MachineError when it
/// cannot be started or the result not be renamed.
void mesh_geometry(const MeshRequest& request);

}  // namespace sazare::geometry
