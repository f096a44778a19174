#pragma once

#include "sazare/cases/case_file.hpp"

namespace sazare::cases {

/// A physical surface group of a mesh: its triangles on the outside of the body and those between two
/// elements.
struct MeshSurface {
  std::string name;
  long outer_faces = 0;
  long inner_faces = 0;
  std::vector<std::string> regions = {};  ///< of the elements behind its outer faces
};

/// What a case may refer to in its mesh.
struct MeshGroups {
  std::vector<std::string> regions;
  std::vector<MeshSurface> surfaces;
};

/// Checks every region and surface that a case of method blocks names against the mesh, and that each region has exactly one
/// material. Throws a UserError like `read_case`.
void check_against_mesh(const CaseFile& file, const MeshGroups& groups);

}  // namespace sazare::cases
