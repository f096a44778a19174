#pragma once

/// Forces on spheres, gathered block by block in an order that does not depend on the number of threads.
///
/// A block's contacts add to loads of its own: those of its spheres, and one more for each sphere of another block that it
/// touches, its guests. When all blocks are done, each sphere takes what stands for it as a guest, in the order of the blocks.

#include <vector>

#include "sazare/neighbors/sphere_pairs.hpp"

namespace sazare::methods::spheres {

class LoadTable {
 public:
  /// Where the contacts of these pairs write: `slot(p)` is the load of the second sphere of pair p.
  void arrange(const neighbors::SpherePairs& pairs);

  std::size_t blocks() const { return blocks_; }
  std::size_t begin_of(std::size_t block) const { return block * neighbors::block_size; }
  std::size_t end_of(std::size_t block) const { return std::min((block + 1) * neighbors::block_size, spheres_); }

  /// Loads of a block at zero.
  void clear(std::size_t block);
  /// Adds what guests of other blocks brought to the spheres of a block.
  void gather(std::size_t block);

  state::SphereLoad* data() { return loads_.data(); }
  const state::SphereLoad& of(std::size_t sphere) const { return loads_[sphere]; }
  const Index* slots() const { return slot_.data(); }

  /// The loads of the spheres.
  void columns(Archive& archive);

 private:
  struct Guest {
    Index sphere = 0, load = 0;
  };

  std::size_t spheres_ = 0, blocks_ = 0;
  std::vector<Index> slot_;                ///< by pair
  std::vector<state::SphereLoad> loads_;   ///< of all spheres, then of the guests of each block
  std::vector<std::size_t> guest_begin_;   ///< by block, in loads_
  std::vector<std::vector<Guest>> homecoming_;  ///< by block: its spheres that are guests elsewhere
};

}  // namespace sazare::methods::spheres
