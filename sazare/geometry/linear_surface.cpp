#include "sazare/geometry/linear_surface.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "sazare/core/error.hpp"
#include "sazare/geometry/interface_split.hpp"

namespace sazare::geometry {

namespace {

using Simplex = std::array<int, 3>;

/// How a face is cut into linear ones, by the places of its nodes; of segments the first two numbers.
std::vector<Simplex> cuts_of(ElementShape shape) {
  switch (shape) {
    case ElementShape::line2:
      return {{0, 1, 0}};
    case ElementShape::line3:
      return {{0, 2, 0}, {2, 1, 0}};
    case ElementShape::triangle3:
      return {{0, 1, 2}};
    case ElementShape::triangle6:
      return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    case ElementShape::quadrilateral4:
      return {{0, 1, 2}, {0, 2, 3}};
    case ElementShape::quadrilateral8:
      return {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {6, 3, 7}, {4, 5, 6}, {4, 6, 7}};
    case ElementShape::quadrilateral9:
      return {{0, 4, 8}, {4, 1, 8}, {1, 5, 8}, {5, 2, 8}, {2, 6, 8}, {6, 3, 8}, {3, 7, 8}, {7, 0, 8}};
    default:
      return {};
  }
}

/// The nodes of a face as its element has them, seen from outside; empty where it is none of the element's faces.
std::vector<Index> seen_from_outside(const MeshElement& element, const MeshElement& face) {
  std::vector<Index> wanted(face.node_list().begin(), face.node_list().end());
  std::ranges::sort(wanted);
  for (const ElementFace& one : faces_of(element.shape)) {
    std::vector<Index> nodes;
    for (const int place : one.nodes) nodes.push_back(element.nodes[static_cast<std::size_t>(place)]);
    std::vector<Index> sorted = nodes;
    std::ranges::sort(sorted);
    if (sorted == wanted) return nodes;
  }
  return {};
}

}  // namespace

LinearSurface linear_surface(const ElementMesh& mesh, const ElementGroup& group) {
  LinearSurface surface;
  surface.dimension = mesh.dimension;
  const auto beside = elements_beside(mesh, group);
  std::vector<Index> corners;  // nodes of the mesh
  for (std::size_t i = 0; i < group.elements.size(); ++i) {
    if (beside[i] < 0) throw UserError(fmt::format("the group \"{}\" has elements that are not faces of the body", group.name));
    const auto nodes = seen_from_outside(mesh.elements[static_cast<std::size_t>(beside[i])], group.elements[i]);
    for (const Simplex& cut : cuts_of(group.elements[i].shape)) {
      const auto node = [&](int k) { return nodes[static_cast<std::size_t>(cut[static_cast<std::size_t>(k)])]; };
      if (mesh.dimension == 2)
        corners.insert(corners.end(), {node(1), node(0)});  // the outside of an element's side is on its right
      else
        corners.insert(corners.end(), {node(0), node(1), node(2)});
    }
  }
  surface.nodes = corners;
  std::ranges::sort(surface.nodes);
  surface.nodes.erase(std::ranges::unique(surface.nodes).begin(), surface.nodes.end());
  for (const Index node : corners)
    surface.faces.push_back(static_cast<Index>(std::ranges::lower_bound(surface.nodes, node) - surface.nodes.begin()));
  return surface;
}

}  // namespace sazare::geometry
