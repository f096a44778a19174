#pragma once

#include "sazare/cases/case_file.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::cases {

/// A physical surface group of a mesh: its triangles on the outside of the body and those between two
/// elements.
struct MeshSurface {
  std::string name;
  long outer_faces = 0;
  long inner_faces = 0;
  std::vector<std::string> regions = {};  ///< of the elements behind its outer faces
  Vector3 area = Vector3::Zero();         ///< of its outer faces as seen along each axis, whichever way they look [m2]
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
