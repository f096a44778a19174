#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"

namespace sazare::geometry {

/// A face that two elements share. Local face f of a tetrahedron is the one opposite its corner f.
struct InteriorFace {
  std::int32_t element_i;             ///< the smaller element index
  std::int32_t element_j;             ///< the larger element index
  std::int32_t face_i;                ///< local face of element i, 0..3
  std::int32_t face_j;                ///< local face of element j, 0..3
  std::array<std::int32_t, 3> nodes;  ///< counter-clockwise seen from outside element i
};

/// A face of one element only.
struct OuterFace {
  std::int32_t element;
  std::int32_t face;                  ///< local face, 0..3
  std::array<std::int32_t, 3> nodes;  ///< counter-clockwise seen from outside the element
};

/// All faces of a mesh; each list is sorted by element (element i), then by its local face.
struct FaceMap {
  std::vector<InteriorFace> interior;
  std::vector<OuterFace> outer;
};

/// Where the triangles of a surface group are: indices into FaceMap::interior and FaceMap::outer, increasing.
struct SurfaceFaces {
  std::vector<std::int32_t> interior;
  std::vector<std::int32_t> outer;
};

/// Finds the faces of a mesh in a time proportional to its number of elements.
/// Throws UserError, with element numbers, when more than two elements share a face.
FaceMap build_face_map(const TetraMesh& mesh);

/// Finds the faces of every surface group, in the order of mesh.surfaces.
/// Throws UserError, naming the group and its nodes' places, when a triangle is no face of any element.
std::vector<SurfaceFaces> find_surface_faces(const TetraMesh& mesh, const FaceMap& faces);

}  // namespace sazare::geometry
