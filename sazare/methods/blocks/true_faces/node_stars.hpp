#pragma once

/// The blocks around each node of the mesh, and which of them joints still hold together there.

#include <span>
#include <vector>

#include "sazare/geometry/tetra_mesh.hpp"
#include "sazare/methods/blocks/bonded_faces.hpp"

namespace sazare::methods::blocks {

class NodeStars {
public:
  /// `corners` and `joints` must outlive it.
  NodeStars(const geometry::ElementCorners& corners, const BondedFaces& joints);

  /// Blocks with a corner at a node, rising.
  std::span<const Index> around(Index node) const {
    const auto begin = begin_[at(node)], end = begin_[at(node) + 1];
    return std::span(blocks_).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
  }

  /// Whether two blocks hold together where they meet: by a joint between them or, where they share an edge or a corner, by a
  /// chain of joints around it.
  bool hold_together(Index first, Index second) const;

private:
  bool chain_around(Index node, Index first, Index second) const;

  geometry::ElementCorners corners_;
  const BondedFaces* joints_;
  std::vector<std::int64_t> begin_;  ///< by node
  std::vector<Index> blocks_;
};

}  // namespace sazare::methods::blocks
