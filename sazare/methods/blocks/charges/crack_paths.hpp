#pragma once

/// Where gas may go: faces between elements, which may become cracks, and what they meet at their edges.

#include <array>
#include <span>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/geometry/face_map.hpp"

namespace sazare::methods::blocks {

/// An outer face that gas meets: the wall of a hole, or a free face, where it leaves.
struct GasOuterFace {
  std::array<std::int32_t, 3> nodes;
  Index wall_face = -1;  ///< number of the charged face; -1 for a free face
};

class CrackPaths {
public:
  /// What stands around an edge. Numbers rise.
  struct Edge {
    std::span<const Index> faces;  ///< between elements
    std::span<const Index> walls;  ///< charged faces
    bool is_free = false;
  };

  CrackPaths(std::span<const geometry::InteriorFace> faces, std::span<const GasOuterFace> outer);

  /// The three edges of a face between elements; edge k lies between its nodes k and k + 1.
  const std::array<Index, 3>& edges_of(Index face) const { return edges_of_[at(face)]; }
  Edge edge(Index number) const;
  Index edge_count() const { return static_cast<Index>(edges_.size()); }

private:
  struct Range {
    Index begin = 0, middle = 0, end = 0;  ///< of faces, then of walls
    bool is_free = false;
  };

  std::vector<std::array<Index, 3>> edges_of_;
  std::vector<Range> edges_;
  std::vector<Index> around_;
};

}  // namespace sazare::methods::blocks
