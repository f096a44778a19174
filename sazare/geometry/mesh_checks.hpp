#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sazare/geometry/element_mesh.hpp"
#include "sazare/geometry/face_map.hpp"
#include "sazare/geometry/tetra_mesh.hpp"

namespace sazare::geometry {

/// Refuses a mesh that cannot be simulated, with the numbers of the elements concerned (UserError):
/// elements without volume or turned inside out; elements that overlap; outer faces that lie on each other in
/// one plane without being one face (an interface that does not conform). The last is allowed where both
/// faces belong to named surface groups: then the gap is meant, as a slit or two bodies in contact.
void check_mesh(const TetraMesh& mesh);

/// Refuses a mesh of finite elements in which two nodes stand in one place, or two elements have the same nodes (UserError): its
/// parts would go through each other, or count twice.
void check_conforming(const ElementMesh& mesh);

/// Pairs of outer faces (indices into faces.outer, the smaller first) that lie in one plane back to back and
/// overlap by more than a sliver; sorted.
std::vector<std::pair<std::int32_t, std::int32_t>> find_touching_outer_faces(const TetraMesh& mesh, const FaceMap& faces);

}  // namespace sazare::geometry
