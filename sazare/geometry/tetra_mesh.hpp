#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sazare/core/vector.hpp"
#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::geometry {

/// A mesh of first-order tetrahedra, as read from a file: every element has a positive volume
/// (nodes 1, 2, 3 are counter-clockwise seen from outside, with node 0 behind them) and belongs to one
/// region.
struct TetraMesh {
  /// A named set of triangles, outer faces or faces inside the body.
  struct Surface {
    std::string name;
    std::vector<std::array<std::int32_t, 3>> triangles;  ///< node indices, (n, 3)
  };

  std::vector<Vector3> nodes;                           ///< positions [m], (n, 3)
  std::vector<std::array<std::int32_t, 4>> tetrahedra;  ///< node indices, (n, 4)
  std::vector<std::int32_t> region;                     ///< index into region_names, one per tetrahedron
  std::vector<std::string> region_names;                ///< physical volume groups
  std::vector<Surface> surfaces;                        ///< physical surface groups
  std::vector<std::int64_t> tags;                       ///< element numbers of the file, for messages
};

/// The number by which messages name an element: the file's, or its index + 1 where the mesh has no numbers.
inline std::int64_t element_tag(const TetraMesh& mesh, std::int32_t element) {
  const auto index = static_cast<std::size_t>(element);
  return index < mesh.tags.size() ? mesh.tags[index] : static_cast<std::int64_t>(element) + 1;
}

/// The corners of a mesh's elements, as a view: nodes and elements must stay where they are.
struct ElementCorners {
  std::span<const Vector3> nodes;                           ///< positions [m]
  std::span<const std::array<std::int32_t, 4>> tetrahedra;  ///< node indices

  std::array<Vector3, 4> of(std::int32_t element) const {
    const auto& own = tetrahedra[static_cast<std::size_t>(element)];
    const auto at = [&](std::size_t corner) { return nodes[static_cast<std::size_t>(own[corner])]; };
    return {at(0), at(1), at(2), at(3)};
  }
};

/// The corners of an element [m].
inline std::array<Vector3, 4> corners_of(const TetraMesh& mesh, std::int32_t element) {
  return ElementCorners{mesh.nodes, mesh.tetrahedra}.of(element);
}

/// The volume of all elements [m3].
inline Real volume(const TetraMesh& mesh) {
  Real sum = 0;
  for (std::size_t element = 0; element < mesh.tetrahedra.size(); ++element)
    sum += volume(corners_of(mesh, static_cast<std::int32_t>(element)));
  return sum;
}

}  // namespace sazare::geometry
