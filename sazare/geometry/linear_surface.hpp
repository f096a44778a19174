#pragma once

/// A surface of a body of finite elements as segments or triangles.

#include "sazare/geometry/element_mesh.hpp"

namespace sazare::geometry {

struct LinearSurface {
  int dimension = 3;         ///< of the body
  std::vector<Index> nodes;  ///< of the mesh
  std::vector<Index> faces;  ///< places in `nodes`, `dimension` to a face: in 2-D segments with the outside on their left, in 3-D
                             ///< triangles that turn counterclockwise seen from outside
};

/// The surface of a group of outer faces. A face of a quadratic element becomes several, with the nodes on its sides; a
/// quadrilateral becomes triangles. Nodes come in the order of the mesh, faces in that of the group. Throws UserError where an element of the group is
/// no face of the body.
LinearSurface linear_surface(const ElementMesh& mesh, const ElementGroup& group);

}  // namespace sazare::geometry
