#include "sazare/methods/spheres/ranks/rank_search.hpp"

#include <algorithm>
#include <compare>
#include <utility>

#include "sazare/core/large_tables.hpp"
#include "sazare/methods/spheres/ranks/near_tiles.hpp"
#include "sazare/neighbors/pair_levels.hpp"
#include "sazare/parallel/places_among_ranks.hpp"

namespace sazare::methods::spheres {

namespace {

/// Spheres stand by it: the finest active level first, then along the curve, then as they stand now.
struct PlaceKey {
  std::int64_t below_finest = 0;  ///< active level
  std::uint64_t cell = 0;
  std::int64_t place = 0;

  auto operator<=>(const PlaceKey&) const = default;
};

/// Some spheres on their way to another rank.
struct SphereRecords {
  std::vector<Index> at;  ///< places
  std::vector<state::SpherePlace> place;
  std::vector<state::SphereSpin> spin;
  std::vector<state::SphereKick> kick;
  std::vector<state::SphereTurn> turn;
  std::vector<Index> number;

  /// Sphere i, which is to stand at a place.
  void take(const state::Spheres& spheres, std::size_t i, Index place_of_it) {
    at.push_back(place_of_it);
    place.push_back(spheres.place[i]);
    spin.push_back(spheres.spin[i]);
    kick.push_back(spheres.kick[i]);
    if (!spheres.turn.empty()) turn.push_back(spheres.turn[i]);
    number.push_back(spheres.number[i]);
  }

  void put(state::Spheres& spheres) const {
    for (std::size_t n = 0; n < at.size(); ++n) {
      const auto i = static_cast<std::size_t>(at[n]);
      spheres.place[i] = place[n];
      spheres.spin[i] = spin[n];
      spheres.kick[i] = kick[n];
      if (!turn.empty()) spheres.turn[i] = turn[n];
      spheres.number[i] = number[n];
    }
  }

  void carry(Parcel& parcel) {
    parcel(at);
    parcel(place);
    parcel(spin);
    parcel(kick);
    parcel(turn);
    parcel(number);
  }
};

/// Nothing is known of the spheres any more but how many they are.
void forget_all(state::Spheres& spheres) {
  forget(spheres.place);
  forget(spheres.spin);
  forget(spheres.kick);
  forget(spheres.turn);
  forget(spheres.number);
}

/// What sizes all spheres have.
neighbors::SphereSizes agreed_sizes(const RankTiles& ranks, const state::Spheres& spheres) {
  neighbors::SphereExtent own;
  for (const std::size_t tile : ranks.owners().own()) own.add(spheres, tile * neighbors::tile_size, ranks.end_of(tile));
  neighbors::SphereSizes sizes(ranks.sum(own, parallel::Topic::search));
  ranks.visit_own([&](std::size_t i) { sizes.take(spheres.place[i].radius); });
  for (const auto& radii : ranks.from_all(sizes.radius, parallel::Topic::search))
    for (const Real radius : radii) sizes.take(radius);
  return sizes;
}

}  // namespace

RankSearch::RankSearch(RankTiles& ranks, state::Spheres& spheres, Real margin, std::span<const std::int8_t> level, int finest)
    : ranks_(&ranks), spheres_(&spheres), margin_(margin), level_(level), finest_(finest), sizes_(agreed_sizes(ranks, spheres)) {}

std::vector<Index> RankSearch::new_places() {
  const std::vector<std::int8_t> active = active_levels();
  const neighbors::CellGrid grid = neighbors::order_grid(spheres_->box, sizes_, margin_);
  std::vector<PlaceKey> keys;
  std::vector<std::size_t> own_of_level(finest() + 1, 0);
  ranks_->visit_own([&](std::size_t i) {
    const std::size_t level = active.empty() ? 0 : static_cast<std::size_t>(active[i]);
    keys.push_back({static_cast<std::int64_t>(finest() - level), grid.key(grid.place_of(spheres_->place[i].centre())),
                    static_cast<std::int64_t>(i)});
    for (std::size_t l = 0; l <= level; ++l) ++own_of_level[l];
  });
  const std::vector<std::size_t> of_all = ranks_->join(own_of_level, parallel::Topic::search);
  of_level_.assign(finest() + 1, 0);
  for (std::size_t n = 0; n < of_all.size(); ++n) of_level_[n % of_level_.size()] += of_all[n];
  places_ = parallel::places_among_ranks(ranks_->ranks(), keys, parallel::Topic::search);
  std::vector<Index> by_place(spheres_->size(), -1);
  for (std::size_t n = 0; n < keys.size(); ++n) by_place[static_cast<std::size_t>(keys[n].place)] = places_[n];
  ranks_->border().tell_of_ghosts(by_place);
  return by_place;
}

/// By place, of own spheres; empty where all are at one level.
std::vector<std::int8_t> RankSearch::active_levels() const {
  if (level_.empty()) return {};
  know_nearby();
  const std::vector<Index> known = ranks_->known();
  const std::vector<std::int8_t> level = levels_of(known);
  const neighbors::SpherePairs all = neighbors::find_pairs(*spheres_, margin_, {}, {sizes_, known});
  return neighbors::active_levels_of(all, {level, finest_});
}

/// By place, of known spheres.
std::vector<std::int8_t> RankSearch::levels_of(const std::vector<Index>& known) const {
  std::vector<std::int8_t> level(spheres_->size(), 0);
  for (const Index i : known)
    level[static_cast<std::size_t>(i)] = level_[static_cast<std::size_t>(spheres_->number[static_cast<std::size_t>(i)])];
  return level;
}

void RankSearch::know_nearby() const {
  std::vector<SphereRecords> to_each;
  for (const std::vector<Index>& near : spheres_near_others(*ranks_, *spheres_, margin_)) {
    to_each.emplace_back();
    for (const Index i : near) to_each.back().take(*spheres_, static_cast<std::size_t>(i), i);
  }
  std::vector<Index> near;
  for (const SphereRecords& arrived : ranks_->hand_on(std::move(to_each))) {
    arrived.put(*spheres_);
    near.insert(near.end(), arrived.at.begin(), arrived.at.end());
  }
  ranks_->set_near(std::move(near));
}

void RankSearch::move() {
  std::vector<SphereRecords> to_each(static_cast<std::size_t>(ranks_->ranks().size()));
  const std::vector<Index> own = ranks_->own_places();
  ranks_->divide(of_level_);
  for (std::size_t n = 0; n < own.size(); ++n)
    to_each[static_cast<std::size_t>(ranks_->owners().owner_of_sphere(places_[n]))].take(*spheres_, static_cast<std::size_t>(own[n]),
                                                                                        places_[n]);
  forget_all(*spheres_);
  for (const SphereRecords& arrived : ranks_->hand_on(std::move(to_each))) arrived.put(*spheres_);
  know_nearby();
}

std::vector<neighbors::SpherePairs> RankSearch::pairs() const {
  const std::vector<Index> known = ranks_->known();
  std::vector<neighbors::SpherePairs> pairs;
  pairs.push_back(neighbors::find_pairs(*spheres_, margin_, ranks_->owners().is_own(), {sizes_, known}));
  if (level_.empty()) return pairs;
  return neighbors::split_by_level(pairs.front(), levels_of(known), of_level_);
}

}  // namespace sazare::methods::spheres
