#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::geometry {

/// A mesh of first-order tetrahedra, as read from a file: every element has a positive volume
/// (nodes 1, 2, 3 are counter-clockwise seen from outside, with node 0 behind them) and belongs to one region.
struct TetraMesh {
  /// A named set of triangles, outer faces or faces inside the body.
  struct Surface {
    std::string name;
    std::vector<std::array<std::int32_t, 3>> triangles;  ///< node indices, (n, 3)
  };

  std::vector<Vector3> nodes;                          ///< positions [m], (n, 3)
  std::vector<std::array<std::int32_t, 4>> tetrahedra;  ///< node indices, (n, 4)
  std::vector<std::int32_t> region;                    ///< index into region_names, one per tetrahedron
  std::vector<std::string> region_names;               ///< physical volume groups
  std::vector<Surface> surfaces;                       ///< physical surface groups
  std::vector<std::int64_t> tags;                      ///< element numbers of the file, for messages
};

}  // namespace sazare::geometry
