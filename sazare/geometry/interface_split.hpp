#pragma once

/// Cuts a mesh along faces between its elements: each side gets nodes of its own.

#include "sazare/geometry/element_mesh.hpp"

namespace sazare::geometry {

/// A face of a mesh that two elements shared: the same places, named by the nodes of either side.
struct InterfaceFace {
  MeshElement first;   ///< as the element on the first side has it: its normal points to the second side
  MeshElement second;  ///< the same places in the same order, nodes of the second side
};

/// A face between two elements of a mesh.
struct SharedFace {
  Index first = 0;  ///< element
  int face = 0;     ///< of the first element
  Index second = 0;
};

/// Faces between elements of two regions; the first element of each is in region `first`.
std::vector<SharedFace> faces_between(const ElementMesh& mesh, Index first, Index second);

/// Faces that a group names and that two elements share; the first element is the one that comes first in the mesh.
std::vector<SharedFace> faces_of_group(const ElementMesh& mesh, const ElementGroup& group);

/// Cuts the mesh along all lists of faces at once; returns the faces list by list. Around every node the elements that still hang
/// together through faces keep a node together: where a cut ends inside the body, its last node stays one. A group takes the
/// nodes of the element whose face or side it is; of several, the first one's.
std::vector<std::vector<InterfaceFace>> split(ElementMesh& mesh, const std::vector<std::vector<SharedFace>>& cuts);

/// The elements of the body beside each element of a group of faces: the first one that has it as its face; -1 where none.
std::vector<Index> elements_beside(const ElementMesh& mesh, const ElementGroup& group);

}  // namespace sazare::geometry
