#pragma once

#include "sazare/cases/case_file.hpp"
#include "sazare/geometry/tetra_mesh.hpp"

namespace sazare::runs {

/// The mesh of a case, checked against it. A .geo is meshed by gmsh into `made`, unless `keep` and it is there already.
/// Throws UserError when the mesh cannot be used or does not fit the case.
geometry::TetraMesh load_mesh(const cases::CaseFile& file, const std::filesystem::path& made, bool keep);

}  // namespace sazare::runs
