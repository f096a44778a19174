#pragma once

/// Forces on spheres, gathered block by block in an order that does not depend on the number of threads.
///
/// A block's contacts add to loads of its own: those of its spheres, and one more for each sphere of another block that it
/// looks at, its guests. These stand behind it in memory, so that the loads of a block are whole as soon as it and all blocks
/// before it are done; each sphere takes what stands for it as a guest, in the order of the blocks.

#include <algorithm>
#include <span>
#include <vector>

#include "sazare/neighbors/sphere_pairs.hpp"

namespace sazare::methods::spheres {

/// Second spheres of the bonds of each block: those of block b are second[begin[b]] .. second[begin[b + 1] - 1], none before the
/// block.
struct BlockLinks {
  std::vector<std::size_t> begin;
  std::vector<Index> second;
};

class LoadTable {
public:
  /// Where the contacts of these pairs and these bonds write.
  void arrange(const neighbors::SpherePairs& pairs, const BlockLinks& bonds);

  std::size_t blocks() const { return blocks_; }
  std::size_t begin_of(std::size_t block) const { return block * neighbors::block_size; }
  std::size_t end_of(std::size_t block) const { return std::min((block + 1) * neighbors::block_size, spheres_); }
  /// The first block whose contacts look at spheres of this one.
  std::size_t first_visitor(std::size_t block) const { return first_visitor_[block]; }

  /// Sets the loads of a block and those of its guests to zero. `own` are the loads of its spheres.
  void clear(std::size_t block, state::SphereLoad* own);
  /// Adds what guests of other blocks brought to the loads of a block.
  void gather(std::size_t block, state::SphereLoad* own) const;

  /// Where the loads of a block's spheres are kept.
  state::SphereLoad* kept(std::size_t block) { return &loads_[begin_of(block)]; }
  const state::SphereLoad& of(std::size_t sphere) const { return loads_[sphere]; }

  /// The load of the second sphere of a pair of a block.
  state::SphereLoad* second(std::size_t pair, state::SphereLoad* own) { return at(slot_[pair], own); }
  /// The same of a bond of a block.
  state::SphereLoad* bonded(std::size_t bond, state::SphereLoad* own) { return at(bond_slot_[bond], own); }

  /// The loads of the spheres.
  void columns(Archive& archive);

private:
  struct Guest {
    Index local = 0;  ///< place in its own block
    Index load = 0;   ///< in guests_
  };

  state::SphereLoad* at(Index slot, state::SphereLoad* own) {
    return slot >= 0 ? own + slot : &guests_[static_cast<std::size_t>(-1 - slot)];
  }
  void find_slots(std::size_t block, const std::vector<Index>& guests, std::span<const Index> seconds,
                  std::span<Index> slots) const;
  void send_home(const std::vector<std::vector<Index>>& guests);

  std::size_t spheres_ = 0, blocks_ = 0;
  std::vector<Index> slot_;                     ///< by pair: place in the block, or below 0 that of the guest
  std::vector<Index> bond_slot_;                ///< the same by bond
  std::vector<state::SphereLoad> loads_;        ///< of all spheres
  std::vector<state::SphereLoad> guests_;       ///< of the guests of each block
  std::vector<std::size_t> guest_begin_;        ///< by block, in guests_
  std::vector<std::vector<Guest>> homecoming_;  ///< by block: its spheres that are guests elsewhere
  std::vector<std::size_t> first_visitor_;      ///< by block
};

}  // namespace sazare::methods::spheres
