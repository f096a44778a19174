#pragma once

/// Forces on spheres, gathered tile by tile in an order that does not depend on the number of threads.
///
/// A tile's contacts add to loads of its own: those of its spheres, and one more for each sphere of another tile that it
/// looks at, its ghosts. These stand behind it in memory, so that the loads of a tile are whole as soon as it and all tiles
/// before it are done; each sphere takes what stands for it as a ghost, in the order of the tiles.
///
/// Threads have shares of the tiles, one after the other. A sphere at which tiles of an earlier share look is deferred: its load
/// is whole, and it may move, when these and its own tile are evaluated. With it wait its neighbours in memory, so that no thread
/// writes to a line of the cache that another one reads.

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "sazare/core/large_tables.hpp"
#include "sazare/neighbors/sphere_pairs.hpp"

namespace sazare::methods::spheres {

/// Second spheres of the bonds of each tile: those of tile b are second[begin[b]] .. second[begin[b + 1] - 1], none before the
/// tile.
struct TileLinks {
  std::vector<std::size_t> begin;
  std::vector<Index> second;
};

/// Places begin .. end - 1 in a tile.
struct PlaceRange {
  std::size_t begin = 0, end = 0;
};

class LoadTable {
public:
  /// Spheres that are deferred together: the records of so many fill whole lines of the cache.
  static constexpr std::size_t together = 8;

  /// Where several ranks share the tiles: by tile, whether it is one of this rank, and what adds the ghosts of the others' tiles
  /// to those of its own.
  struct OfRanks {
    std::span<const std::uint8_t> is_own;
    std::function<void(std::vector<std::vector<Index>>& ghosts)> complete;
  };
  /// Where the contacts of these pairs and these bonds write. All tiles are one share.
  void arrange(const neighbors::SpherePairs& pairs, const TileLinks& bonds, const OfRanks& ranks = {});
  /// Cuts the tiles into shares: share s has the tiles cuts[s] .. cuts[s + 1] - 1. To be called between steps alone.
  void share_out(std::vector<std::size_t> cuts);

  std::size_t tiles() const { return tiles_; }
  std::size_t begin_of(std::size_t tile) const { return tile * neighbors::tile_size; }
  std::size_t end_of(std::size_t tile) const { return std::min((tile + 1) * neighbors::tile_size, spheres_); }
  /// Number of ghosts of all tiles together.
  std::size_t ghosts() const { return ghost_.size(); }
  const std::vector<std::size_t>& cuts() const { return cuts_; }
  /// A tile with deferred spheres.
  struct DeferredTile {
    std::size_t tile = 0;
    std::size_t after = 0;  ///< all tiles of earlier shares that look at them are before this one
  };
  /// Deferred tiles of a share, in the order in which they may move.
  std::span<const DeferredTile> deferred_tiles(std::size_t share) const { return deferred_tiles_[share]; }

  /// Sets the loads of a tile's ghosts to zero, before it is evaluated; those of its own spheres are to be zero then as well.
  void clear_ghosts(std::size_t tile);
  /// The tiles from which a tile has ghosts, in order.
  std::span<const Index> visited_by(std::size_t tile) const { return visited_[tile]; }
  /// Where what a tile's contacts bring to its ghosts adds up.
  std::span<const state::SphereLoad> loads_of_ghosts(std::size_t tile) const {
    return std::span(ghosts_).subspan(ghosts_.size() - ghost_begin_[tile + 1], ghost_begin_[tile + 1] - ghost_begin_[tile]);
  }
  /// The load of one of all ghosts.
  state::SphereLoad& load_of_ghost(Index ghost) { return ghosts_[ghosts_.size() - 1 - static_cast<std::size_t>(ghost)]; }
  /// Which of all ghosts is the first one of a tile.
  std::size_t first_ghost(std::size_t tile) const { return ghost_begin_[tile]; }
  /// The ghosts of a tile, in order.
  std::span<const Index> ghosts(std::size_t tile) const {
    return std::span(ghost_).subspan(ghost_begin_[tile], ghost_begin_[tile + 1] - ghost_begin_[tile]);
  }
  /// Adds what ghosts of other tiles brought to the loads of a tile, all of which are evaluated.
  void gather(std::size_t tile, state::SphereLoad* own) const {
    add(in_time_[tile].ghosts, own);
    add(deferred_[tile].ghosts, own);
  }
  /// Gathers for the spheres of a tile that are not deferred, as soon as those before it of its share are evaluated. The others'
  /// loads are kept for `gather_deferred` and become zero in `own`.
  void gather_in_time(std::size_t tile, state::SphereLoad* own);
  /// Which are not deferred, and which are.
  std::span<const PlaceRange> places_in_time(std::size_t tile) const { return in_time_[tile].places; }
  std::span<const PlaceRange> deferred_places(std::size_t tile) const { return deferred_[tile].places; }
  /// Gathers for the spheres that are deferred, whose loads come to where they stand in `own`.
  void gather_deferred(std::size_t tile, state::SphereLoad* own) const;

  /// Where the loads of a tile's spheres are kept; there is no memory for them before they are asked for.
  std::span<state::SphereLoad> kept(std::size_t tile) {
    if (kept_[tile].empty()) kept_[tile].resize(end_of(tile) - begin_of(tile));
    return kept_[tile];
  }
  const state::SphereLoad& of(std::size_t sphere) const {
    return kept_[sphere / neighbors::tile_size][sphere % neighbors::tile_size];
  }
  bool keeps(std::size_t tile) const { return !kept_[tile].empty(); }
  /// Gives back the memory of all loads that are kept.
  void forget() { kept_.assign(tiles_, {}); }

  /// Where what a tile's contacts bring to a sphere, its own or one of a later tile, adds up.
  Index slot(std::size_t tile, Index sphere) const;
  /// Finds the load of a slot; `own` are the loads of the tile's spheres, and those of ghosts stand before `end`.
  class Slots {
  public:
    Slots(state::SphereLoad* own, state::SphereLoad* end) : own_(own), end_(end) {}
    /// Without a branch: nobody foretells which contact has a ghost.
    state::SphereLoad* operator[](Index slot) const { return (slot < 0 ? end_ : own_) + slot; }

  private:
    state::SphereLoad *own_, *end_;
  };
  Slots slots(state::SphereLoad* own) { return {own, ghosts_.data() + ghosts_.size()}; }
  /// The load of the second sphere of a bond of a tile.
  state::SphereLoad* bonded(std::size_t bond, state::SphereLoad* own) { return slots(own)[bond_slot_[bond]]; }

  /// What a step reads.
  void add_to(LargePages& pages) const { pages.add(ghosts_); }

  /// The loads of the spheres, which all have to be kept.
  void columns(Archive& archive);

private:
  struct Ghost {
    Index local = 0;  ///< place in its own tile
    Index load = 0;   ///< which of all ghosts
  };

  /// Spheres of a tile that move at one time.
  struct Batch {
    std::vector<PlaceRange> places;
    std::vector<Ghost> ghosts;  ///< the spheres among these on which other tiles act
  };

  void send_home();
  void part_deferred(std::size_t tile, std::size_t share);
  void add(const std::vector<Ghost>& ghosts, state::SphereLoad* own) const;

  std::size_t spheres_ = 0, tiles_ = 0;
  std::vector<Index> bond_slot_;                                ///< by bond, see `slot`
  std::vector<std::vector<state::SphereLoad>> kept_;            ///< by tile
  std::vector<Index> ghost_;                                    ///< the ghosts of each tile, in order
  std::vector<state::SphereLoad> ghosts_;                       ///< their loads, the last one first
  std::vector<std::size_t> ghost_begin_;                        ///< by tile, in ghost_
  std::vector<std::vector<Index>> visited_;                     ///< by tile: those from which it has ghosts
  std::vector<std::size_t> cuts_;                               ///< first tile of each share, and the end
  std::vector<Batch> in_time_, deferred_;                       ///< by tile
  std::vector<std::vector<DeferredTile>> deferred_tiles_;       ///< by share
  std::vector<std::vector<state::SphereLoad>> deferred_loads_;  ///< by tile, before those of ghosts are added
};

}  // namespace sazare::methods::spheres
