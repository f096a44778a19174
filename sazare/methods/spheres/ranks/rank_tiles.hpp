#pragma once

/// The spheres that several ranks share. A rank works for its own tiles: it knows the motion of their spheres and of those near
/// them, their candidate pairs and contacts, evaluates these and moves its spheres.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "sazare/core/parcel.hpp"
#include "sazare/methods/spheres/ranks/border.hpp"
#include "sazare/methods/spheres/ranks/tile_owners.hpp"
#include "sazare/methods/spheres/stepper/tile_shares.hpp"
#include "sazare/parallel/give.hpp"
#include "sazare/parallel/plain_records.hpp"

namespace sazare::methods::spheres {

/// How tiles get their owners.
enum class Division {
  even,      ///< as many for each, for good
  measured,  ///< ranges of the order of tiles that have taken as much processor time
  random,    ///< drawn anew at every search: a trial of what ranks tell each other
};

/// A range of the tiles of each active level for each rank; a tile counts for the level of its first sphere. `spheres`: see
/// `RankTiles::divide`.
std::vector<int> owners_by_level(std::span<const std::size_t> spheres, int ranks);

/// Packs or unpacks a record by its own `carry`, or as it is where it has none.
template <class Record>
void carry(Parcel& parcel, Record& record) {
  if constexpr (requires { record.carry(parcel); })
    record.carry(parcel);
  else
    parcel(record);
}

class RankTiles {
public:
  RankTiles(const parallel::Ranks& ranks, Division division, std::size_t spheres);

  const parallel::Ranks& ranks() const { return *ranks_; }
  const TileOwners& owners() const { return owners_; }
  Border& border() { return border_; }
  const Border& border() const { return border_; }

  /// Chooses owners anew. `spheres` are how many have each active level or a finer one, and stand first: those of each active
  /// level are shared out evenly, since all meet at every tick. All call it.
  void divide(std::span<const std::size_t> spheres);
  /// Processor time that this rank's tiles took since the last division [s].
  void spent(Real seconds) { seconds_ += seconds; }
  /// Processor time since the beginning [s].
  Real seconds() const { return all_seconds_ + seconds_; }

  /// A plain record of every rank, by rank: to all, or to the first one, which alone then has more than its own. All call it.
  template <class Record>
  std::vector<Record> from_all(const Record& own, parallel::Topic topic, parallel::To to = parallel::To::all) const {
    const parallel::Gathered all = ranks_->gather(std::as_bytes(std::span(&own, 1)), topic, to);
    if (to == parallel::To::first && !ranks_->is_first()) return {own};
    return parallel::records_in<Record>(all.bytes);
  }
  /// The sum of what all ranks have added up without rounding. All call it.
  template <class Sums>
  Sums sum(const Sums& own, parallel::Topic topic = parallel::Topic::rows) const {
    Sums all{};
    for (const Sums& part : from_all(own, topic)) all += part;
    return all;
  }
  template <class Record>
  std::vector<Record> to_first(const Record& own, parallel::Topic topic) const {
    return from_all(own, topic, parallel::To::first);
  }
  /// The lists of all ranks, by rank. All call it.
  template <class Record>
  std::vector<std::vector<Record>> by_rank(const std::vector<Record>& own, parallel::Topic topic) const {
    const parallel::Gathered all = ranks_->gather(std::as_bytes(std::span(own)), topic);
    std::vector<std::vector<Record>> records;
    for (int rank = 0; rank < ranks_->size(); ++rank) records.push_back(parallel::records_in<Record>(all.of(rank)));
    return records;
  }
  /// One after the other.
  template <class Record>
  std::vector<Record> join(const std::vector<Record>& own, parallel::Topic topic) const {
    std::vector<Record> all;
    for (const std::vector<Record>& records : by_rank(own, topic)) all.insert(all.end(), records.begin(), records.end());
    return all;
  }
  /// All call these.
  Real largest(Real own) const;
  bool any(bool own) const;

  /// The motion of all spheres becomes true in every rank, or in the first one. All call it.
  void share(state::Spheres& spheres, parallel::To to, parallel::Topic topic) const;

  /// Gives each rank its records, which can be packed. Returns those that all have given to this one, by rank. All call it.
  template <class Records>
  std::vector<Records> hand_on(std::vector<Records> to_each) const {
    std::vector<std::vector<std::byte>> bytes;
    for (Records& records : to_each) {
      Parcel parcel;
      carry(parcel, records);
      bytes.emplace_back(parcel.packed().begin(), parcel.packed().end());
    }
    std::vector<Records> arrived(to_each.size());
    const auto given = parallel::give(*ranks_, std::move(bytes), parallel::Topic::search);
    for (std::size_t rank = 0; rank < given.size(); ++rank) {
      Parcel parcel(given[rank]);
      carry(parcel, arrived[rank]);
    }
    return arrived;
  }

  /// Gives the first rank a record of each of the first tiles, which its owner packs; elsewhere the list is empty. All call it.
  template <class Record>
  std::vector<Record> collect(std::size_t tiles, const std::function<Record(std::size_t tile)>& of_tile) const {
    Parcel own;
    for (const std::size_t tile : owners_.own()) {
      if (tile >= tiles) break;
      Record record = of_tile(tile);
      carry(own, record);
    }
    const parallel::Gathered all = ranks_->gather(own.packed(), parallel::Topic::state, parallel::To::first);
    if (!ranks_->is_first()) return {};
    std::vector<Record> by_tile(tiles);
    std::vector<Parcel> arrived;
    for (int rank = 0; rank < ranks_->size(); ++rank) arrived.emplace_back(all.of(rank));
    for (std::size_t tile = 0; tile < by_tile.size(); ++tile)
      carry(arrived[static_cast<std::size_t>(owners_.owner(tile))], by_tile[tile]);
    return by_tile;
  }

  std::size_t end_of(std::size_t tile) const { return std::min((tile + 1) * neighbors::tile_size, spheres_); }
  /// Calls visit(place) for the spheres of a tile.
  template <class Visit>
  void visit_tile(std::size_t tile, Visit&& visit) const {
    for (std::size_t i = tile * neighbors::tile_size; i < end_of(tile); ++i) visit(i);
  }
  /// For those of own tiles.
  template <class Visit>
  void visit_own(Visit&& visit) const {
    for (const std::size_t tile : owners_.own()) visit_tile(tile, visit);
  }
  /// How many spheres stand in own tiles, and their places.
  std::size_t own_spheres() const;
  std::vector<Index> own_places() const;

  /// The places of other ranks' spheres that are known as they were at the last search, in any order.
  void set_near(std::vector<Index> near);
  const std::vector<Index>& near() const { return near_; }
  /// Those of all spheres that are known, own and near, in order.
  std::vector<Index> known() const;

private:
  std::vector<int> next_owners(std::span<const std::size_t> spheres);
  std::vector<int> random_owners() const;

  const parallel::Ranks* ranks_;
  Division division_;
  std::size_t spheres_;
  TileOwners owners_;
  Border border_;
  std::vector<std::size_t> cuts_;  ///< of the tiles into ranges; not where owners are random
  TileCosts costs_;
  std::vector<Index> near_;
  Real seconds_ = 0, all_seconds_ = 0;
  std::uint64_t divisions_ = 0;
};

}  // namespace sazare::methods::spheres
