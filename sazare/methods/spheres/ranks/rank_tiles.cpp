#include "sazare/methods/spheres/ranks/rank_tiles.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <span>
#include <utility>

#include "sazare/core/mixed_hash.hpp"
#include "sazare/core/parcel.hpp"

namespace sazare::methods::spheres {

namespace {

/// Cuts as owners.
std::vector<int> owners_of(const std::vector<std::size_t>& cuts) {
  std::vector<int> owner;
  for (std::size_t rank = 0; rank + 1 < cuts.size(); ++rank)
    owner.insert(owner.end(), cuts[rank + 1] - cuts[rank], static_cast<int>(rank));
  return owner;
}

/// Packs the records of some places, or unpacks them to there.
template <class T>
void carry_places(Parcel& parcel, std::vector<T>& records, std::size_t begin, std::size_t end) {
  const auto first = records.begin() + static_cast<std::ptrdiff_t>(begin),
             last = records.begin() + static_cast<std::ptrdiff_t>(end);
  std::vector<T> some(first, last);
  parcel(some);
  if (parcel.unpacks()) std::ranges::copy(some, first);
}

}  // namespace

RankTiles::RankTiles(const parallel::Ranks& ranks, Division division, std::size_t spheres)
    : ranks_(&ranks), division_(division), spheres_(spheres), owners_(ranks.rank()), border_(ranks) {
  const std::size_t tiles = neighbors::tiles_of(spheres);
  cuts_ = even_cuts(tiles, static_cast<std::size_t>(ranks.size()));
  owners_.take(owners_of(cuts_));
}

void RankTiles::divide(std::span<const std::size_t> spheres) {
  owners_.take(next_owners(spheres));
  ++divisions_;
}

std::vector<int> RankTiles::random_owners() const {
  std::vector<int> owner(owners_.tiles());
  for (std::size_t tile = 0; tile < owner.size(); ++tile)
    owner[tile] = static_cast<int>(mixed_hash(divisions_, tile) % static_cast<std::uint64_t>(ranks_->size()));
  return owner;
}

std::vector<int> owners_by_level(std::span<const std::size_t> spheres, int ranks) {
  std::vector<int> owner;
  for (std::size_t level = spheres.size(); level-- > 0;) {
    const std::size_t end = neighbors::tiles_of(spheres[level]);
    const std::vector<int> more = owners_of(even_cuts(end - owner.size(), static_cast<std::size_t>(ranks)));
    owner.insert(owner.end(), more.begin(), more.end());
  }
  return owner;
}

std::vector<int> RankTiles::next_owners(std::span<const std::size_t> spheres) {
  if (division_ == Division::random) return random_owners();
  const std::vector<Real> of_ranks = from_all(seconds_, parallel::Topic::other);
  all_seconds_ += std::exchange(seconds_, 0);
  if (spheres.size() > 1) return owners_by_level(spheres, ranks_->size());
  const auto seconds = std::span(of_ranks).first(cuts_.size() - 1);  // ranks beyond the last tile have none
  if (division_ == Division::measured && std::ranges::all_of(seconds, [](Real each) { return each > 0; })) {
    costs_.learn(cuts_, seconds);
    cuts_ = costs_.improved(cuts_);
  }
  return owners_of(cuts_);
}

Real RankTiles::largest(Real own) const { return std::ranges::max(from_all(own, parallel::Topic::search)); }

bool RankTiles::any(bool own) const { return std::ranges::max(from_all(std::uint8_t{own}, parallel::Topic::changes)) > 0; }

void RankTiles::share(state::Spheres& spheres, parallel::To to, parallel::Topic topic) const {
  const auto carry_tile = [&](Parcel& parcel, std::size_t tile) {
    const std::size_t begin = tile * neighbors::tile_size, end = end_of(tile);
    carry_places(parcel, spheres.place, begin, end);
    carry_places(parcel, spheres.spin, begin, end);
    carry_places(parcel, spheres.kick, begin, end);
    carry_places(parcel, spheres.number, begin, end);
    if (!spheres.turn.empty()) carry_places(parcel, spheres.turn, begin, end);
  };
  Parcel own;
  for (const std::size_t tile : owners_.own()) carry_tile(own, tile);
  const parallel::Gathered all = ranks_->gather(own.packed(), topic, to);
  if (to == parallel::To::first && !ranks_->is_first()) return;
  std::vector<Parcel> arrived;
  for (int rank = 0; rank < ranks_->size(); ++rank) arrived.emplace_back(all.of(rank));
  for (std::size_t tile = 0; tile < owners_.tiles(); ++tile)
    if (!owners_.owns(tile)) carry_tile(arrived[static_cast<std::size_t>(owners_.owner(tile))], tile);
}

std::size_t RankTiles::own_spheres() const {
  std::size_t own = 0;
  for (const std::size_t tile : owners_.own()) own += end_of(tile) - tile * neighbors::tile_size;
  return own;
}

std::vector<Index> RankTiles::own_places() const {
  std::vector<Index> places;
  places.reserve(own_spheres());
  visit_own([&](std::size_t i) { places.push_back(static_cast<Index>(i)); });
  return places;
}

void RankTiles::set_near(std::vector<Index> near) {
  near_ = std::move(near);
  std::ranges::sort(near_);
}

std::vector<Index> RankTiles::known() const {
  const std::vector<Index> own = own_places();
  std::vector<Index> all;
  all.reserve(own.size() + near_.size());
  std::ranges::merge(own, near_, std::back_inserter(all));
  return all;
}

}  // namespace sazare::methods::spheres
