#include "sazare/methods/blocks/true_faces/node_stars.hpp"

#include <algorithm>

namespace sazare::methods::blocks {

NodeStars::NodeStars(const geometry::ElementCorners& corners, const BondedFaces& joints)
    : corners_(corners), joints_(&joints), begin_(corners.nodes.size() + 1, 0) {
  for (const auto& own : corners.tetrahedra)
    for (const Index node : own) ++begin_[at(node) + 1];
  for (std::size_t node = 0; node < corners.nodes.size(); ++node) begin_[node + 1] += begin_[node];
  blocks_.resize(static_cast<std::size_t>(begin_.back()));
  std::vector<std::int64_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t block = 0; block < corners.tetrahedra.size(); ++block)
    for (const Index node : corners.tetrahedra[block])
      blocks_[static_cast<std::size_t>(next[at(node)]++)] = static_cast<Index>(block);
}

bool NodeStars::hold_together(Index first, Index second) const {
  const auto& theirs = corners_.tetrahedra[at(second)];
  std::vector<Index> shared;
  for (const Index node : corners_.tetrahedra[at(first)])
    if (std::ranges::find(theirs, node) != theirs.end()) shared.push_back(node);
  if (shared.size() > 2) return joints_->bonded(first, second);
  return std::ranges::any_of(shared, [&](Index node) { return chain_around(node, first, second); });
}

bool NodeStars::chain_around(Index node, Index first, Index second) const {
  std::vector<Index> reached{first};
  for (std::size_t next = 0; next < reached.size(); ++next) {  // grows while it is walked
    const Index block = reached[next];
    for (int face = 0; face < 4; ++face) {
      const Index joint = joints_->joint_at(block, face);
      const bool has_node = corners_.tetrahedra[at(block)][static_cast<std::size_t>(face)] != node;
      if (!has_node || joint < 0 || joints_->state(joint) == JointState::broken) continue;
      const Link& link = joints_->links()[at(joint)];
      const Index other = link.first == block ? link.second : link.first;
      if (other == second) return true;
      if (std::ranges::find(reached, other) == reached.end()) reached.push_back(other);
    }
  }
  return false;
}

}  // namespace sazare::methods::blocks
