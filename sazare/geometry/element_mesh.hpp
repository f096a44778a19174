#pragma once

/// A mesh of finite elements of any shape, in the plane or in space.

#include <filesystem>
#include <string>

#include "sazare/geometry/element_shape.hpp"

namespace sazare::geometry {

/// An element, or a face of one: its shape and nodes.
struct MeshElement {
  ElementShape shape = ElementShape::point;
  std::array<Index, most_element_nodes> nodes{};
  std::int64_t tag = 0;  ///< its number in the file; 0 where it has none

  std::span<const Index> node_list() const { return {nodes.data(), static_cast<std::size_t>(facts(shape).nodes)}; }
};

/// A physical group of the file below the body's dimension: faces, lines or points.
struct ElementGroup {
  std::string name;
  int dimension = 0;
  std::vector<MeshElement> elements;
};

struct ElementMesh {
  int dimension = 2;
  std::vector<Vector3> nodes;           ///< [m]
  std::vector<std::int64_t> node_tags;  ///< numbers in the file
  std::vector<MeshElement> elements;
  std::vector<Index> region;  ///< by element
  std::vector<std::string> region_names;
  std::vector<ElementGroup> groups;

  /// nullptr where there is none.
  const ElementGroup* find_group(const std::string& name) const {
    for (const ElementGroup& group : groups)
      if (group.name == name) return &group;
    return nullptr;
  }
};

/// Reads a Gmsh mesh, format 4.1: elements of the dimension in physical groups are the body, its regions the groups; nodes that
/// no element of the body uses are dropped. `scale` multiplies the coordinates (file's unit to metres). Throws UserError for what
/// cannot be used: elements of another dimension than the body's, elements without volume, groups beside the body.
ElementMesh read_element_mesh(const std::filesystem::path& file, int dimension, Real scale);

}  // namespace sazare::geometry
