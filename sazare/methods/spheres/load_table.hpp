#pragma once

/// Forces on spheres, gathered block by block in an order that does not depend on the number of threads.
///
/// A block's contacts add to loads of its own: those of its spheres, and one more for each sphere of another block that it
/// looks at, its guests. These stand behind it in memory, so that the loads of a block are whole as soon as it and all blocks
/// before it are done; each sphere takes what stands for it as a guest, in the order of the blocks.
///
/// Threads have shares of the blocks, one after the other. A sphere at which blocks of an earlier share look is late: its load is
/// whole, and it may move, when these and its own block are evaluated. With it wait its neighbours in memory, so that no thread
/// writes to a line of the cache that another one reads.

#include <algorithm>
#include <span>
#include <vector>

#include "sazare/core/large_tables.hpp"
#include "sazare/neighbors/sphere_pairs.hpp"

namespace sazare::methods::spheres {

/// Second spheres of the bonds of each block: those of block b are second[begin[b]] .. second[begin[b + 1] - 1], none before the
/// block.
struct BlockLinks {
  std::vector<std::size_t> begin;
  std::vector<Index> second;
};

/// Places begin .. end - 1 in a block.
struct PlaceRange {
  std::size_t begin = 0, end = 0;
};

class LoadTable {
public:
  /// Spheres that are late together: the records of so many fill whole lines of the cache.
  static constexpr std::size_t together = 8;

  /// Where the contacts of these pairs and these bonds write. All blocks are one share.
  void arrange(const neighbors::SpherePairs& pairs, const BlockLinks& bonds);
  /// Cuts the blocks into shares: share s has the blocks cuts[s] .. cuts[s + 1] - 1. To be called between steps alone.
  void share_out(std::vector<std::size_t> cuts);

  std::size_t blocks() const { return blocks_; }
  std::size_t begin_of(std::size_t block) const { return block * neighbors::block_size; }
  std::size_t end_of(std::size_t block) const { return std::min((block + 1) * neighbors::block_size, spheres_); }
  /// Number of guests of all blocks together.
  std::size_t guests() const { return guest_.size(); }
  const std::vector<std::size_t>& cuts() const { return cuts_; }
  /// A block with late spheres.
  struct LateBlock {
    std::size_t block = 0;
    std::size_t after = 0;  ///< all blocks of earlier shares that look at them are before this one
  };
  /// Late blocks of a share, in the order in which they may move.
  std::span<const LateBlock> late_blocks(std::size_t share) const { return late_blocks_[share]; }

  /// Sets the loads of a block's guests to zero, before it is evaluated; those of its own spheres are to be zero then as well.
  void clear_guests(std::size_t block);
  /// The blocks from which a block has guests, in order.
  std::span<const Index> visited_by(std::size_t block) const { return visited_[block]; }
  /// Where what a block's contacts bring to its guests adds up.
  std::span<const state::SphereLoad> loads_of_guests(std::size_t block) const {
    return std::span(guests_).subspan(guests_.size() - guest_begin_[block + 1], guest_begin_[block + 1] - guest_begin_[block]);
  }
  /// The guests of a block, in order.
  std::span<const Index> guests(std::size_t block) const {
    return std::span(guest_).subspan(guest_begin_[block], guest_begin_[block + 1] - guest_begin_[block]);
  }
  /// Adds what guests of other blocks brought to the loads of a block, all of which are evaluated.
  void gather(std::size_t block, state::SphereLoad* own) const {
    add(in_time_[block].guests, own);
    add(late_[block].guests, own);
  }
  /// Gathers for the spheres of a block that are not late, as soon as those before it of its share are evaluated. The others'
  /// loads are kept for `gather_late` and become zero in `own`.
  void gather_in_time(std::size_t block, state::SphereLoad* own);
  /// Which are not late, and which are.
  std::span<const PlaceRange> places_in_time(std::size_t block) const { return in_time_[block].places; }
  std::span<const PlaceRange> late_places(std::size_t block) const { return late_[block].places; }
  /// Gathers for the spheres that are late, whose loads come to where they stand in `own`.
  void gather_late(std::size_t block, state::SphereLoad* own) const;

  /// Where the loads of a block's spheres are kept; there is no memory for them before they are asked for.
  std::span<state::SphereLoad> kept(std::size_t block) {
    if (kept_[block].empty()) kept_[block].resize(end_of(block) - begin_of(block));
    return kept_[block];
  }
  const state::SphereLoad& of(std::size_t sphere) const {
    return kept_[sphere / neighbors::block_size][sphere % neighbors::block_size];
  }
  /// Gives back the memory of all loads that are kept.
  void forget() { kept_.assign(blocks_, {}); }

  /// Where what a block's contacts bring to a sphere, its own or one of a later block, adds up.
  Index slot(std::size_t block, Index sphere) const;
  /// Finds the load of a slot; `own` are the loads of the block's spheres, and those of guests stand before `end`.
  class Slots {
  public:
    Slots(state::SphereLoad* own, state::SphereLoad* end) : own_(own), end_(end) {}
    /// Without a branch: nobody foretells which contact has a guest.
    state::SphereLoad* operator[](Index slot) const { return (slot < 0 ? end_ : own_) + slot; }

  private:
    state::SphereLoad *own_, *end_;
  };
  Slots slots(state::SphereLoad* own) { return {own, guests_.data() + guests_.size()}; }
  /// The load of the second sphere of a bond of a block.
  state::SphereLoad* bonded(std::size_t bond, state::SphereLoad* own) { return slots(own)[bond_slot_[bond]]; }

  /// What a step reads.
  void add_to(LargePages& pages) const { pages.add(guests_); }

  /// The loads of the spheres, which all have to be kept.
  void columns(Archive& archive);

private:
  struct Guest {
    Index local = 0;  ///< place in its own block
    Index load = 0;   ///< which of all guests
  };

  /// Spheres of a block that move at one time.
  struct Flock {
    std::vector<PlaceRange> places;
    std::vector<Guest> guests;  ///< the spheres among these on which other blocks act
  };

  void send_home();
  void part_late(std::size_t block, std::size_t share);
  void add(const std::vector<Guest>& guests, state::SphereLoad* own) const;

  std::size_t spheres_ = 0, blocks_ = 0;
  std::vector<Index> bond_slot_;                            ///< by bond, see `slot`
  std::vector<std::vector<state::SphereLoad>> kept_;        ///< by block
  std::vector<Index> guest_;                                ///< the guests of each block, in order
  std::vector<state::SphereLoad> guests_;                   ///< their loads, the last one first
  std::vector<std::size_t> guest_begin_;                    ///< by block, in guest_
  std::vector<std::vector<Index>> visited_;                 ///< by block: those from which it has guests
  std::vector<std::size_t> cuts_;                           ///< first block of each share, and the end
  std::vector<Flock> in_time_, late_;                       ///< by block
  std::vector<std::vector<LateBlock>> late_blocks_;         ///< by share
  std::vector<std::vector<state::SphereLoad>> late_loads_;  ///< by block, before guests come home
};

}  // namespace sazare::methods::spheres
