#include "sazare/methods/spheres/load_table.hpp"

#include <iterator>
#include <span>
#include <utility>

#include "sazare/core/octets.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

/// Collects those of some second spheres that stand at `last` or beyond, each once.
void collect_ghosts(std::span<const Index> seconds, Index last, std::vector<Index>& ghosts) {
  std::ranges::copy_if(seconds, std::back_inserter(ghosts), [&](Index other) { return other >= last; });
  std::ranges::sort(ghosts);
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
}

}  // namespace

void LoadTable::arrange(const neighbors::SpherePairs& pairs, const TileLinks& bonds, const OfRanks& ranks) {
  spheres_ = pairs.first.size() - 1;
  tiles_ = neighbors::tiles_of(spheres_);
  forget();
  std::vector<std::vector<Index>> ghosts(tiles_);
  const auto is_here = [&](std::size_t tile) { return ranks.is_own.empty() || ranks.is_own[tile] != 0; };
  parallel::parallel_for(tiles_, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile) {
      if (!is_here(tile)) continue;
      const auto last = static_cast<Index>(end_of(tile));
      const std::size_t first_pair = pairs.first[begin_of(tile)], last_pair = pairs.first[end_of(tile)];
      collect_ghosts(std::span(pairs.other).subspan(first_pair, last_pair - first_pair), last, ghosts[tile]);
      if (!bonds.begin.empty())
        collect_ghosts(std::span(bonds.second).subspan(bonds.begin[tile], bonds.begin[tile + 1] - bonds.begin[tile]), last,
                       ghosts[tile]);
    }
  });
  if (ranks.complete) ranks.complete(ghosts);
  ghost_begin_.assign(1, 0);
  for (const auto& list : ghosts) ghost_begin_.push_back(ghost_begin_.back() + list.size());
  ghost_.clear();
  ghost_.reserve(ghost_begin_.back());
  for (const auto& list : ghosts) ghost_.insert(ghost_.end(), list.begin(), list.end());
  visited_.assign(tiles_, {});
  for (std::size_t tile = 0; tile < tiles_; ++tile)
    for (const Index ghost : ghosts[tile])
      if (const Index home = ghost / static_cast<Index>(neighbors::tile_size);
          visited_[tile].empty() || visited_[tile].back() != home)
        visited_[tile].push_back(home);
  bond_slot_.resize(bonds.second.size());
  for (std::size_t tile = 0; tile + 1 < bonds.begin.size(); ++tile)
    for (std::size_t bond = bonds.begin[tile]; is_here(tile) && bond < bonds.begin[tile + 1]; ++bond)
      bond_slot_[bond] = slot(tile, bonds.second[bond]);
  share_out({0, tiles_});
}

Index LoadTable::slot(std::size_t tile, Index sphere) const {
  if (static_cast<std::size_t>(sphere) < end_of(tile)) return sphere - static_cast<Index>(begin_of(tile));
  const auto begin = ghost_.begin() + static_cast<std::ptrdiff_t>(ghost_begin_[tile]),
             end = ghost_.begin() + static_cast<std::ptrdiff_t>(ghost_begin_[tile + 1]);
  return -1 - static_cast<Index>(std::lower_bound(begin, end, sphere) - ghost_.begin());
}

void LoadTable::share_out(std::vector<std::size_t> cuts) {
  cuts_ = std::move(cuts);
  send_home();
  deferred_.assign(tiles_, {});
  deferred_loads_.assign(tiles_, {});
  deferred_tiles_.assign(cuts_.size() - 1, {});
  for (std::size_t share = 1; share < deferred_tiles_.size(); ++share) {
    for (std::size_t tile = cuts_[share]; tile < cuts_[share + 1]; ++tile) part_deferred(tile, share);
    std::ranges::stable_sort(deferred_tiles_[share], {}, &DeferredTile::after);
  }
}

/// Room for the loads of ghosts, and where they belong.
void LoadTable::send_home() {
  ghosts_.assign(ghost_.size(), {});
  in_time_.assign(tiles_, {});
  for (std::size_t tile = 0; tile < tiles_; ++tile) in_time_[tile].places = {{0, end_of(tile) - begin_of(tile)}};
  for (std::size_t tile = 0; tile < tiles_; ++tile)
    for (std::size_t n = ghost_begin_[tile]; n < ghost_begin_[tile + 1]; ++n) {
      const std::size_t home = static_cast<std::size_t>(ghost_[n]) / neighbors::tile_size;
      in_time_[home].ghosts.push_back({ghost_[n] - static_cast<Index>(begin_of(home)), static_cast<Index>(n)});
    }
}

/// Tells the deferred spheres of a tile from the others.
void LoadTable::part_deferred(std::size_t tile, std::size_t share) {
  const std::size_t count = end_of(tile) - begin_of(tile);
  std::vector<std::uint8_t> is_deferred((count + together - 1) / together, 0);
  const std::vector<Ghost> ghosts = std::move(in_time_[tile].ghosts);
  const auto deferred_of = [&](const Ghost& ghost) -> std::uint8_t& {
    return is_deferred[static_cast<std::size_t>(ghost.local) / together];
  };
  std::size_t after = 0;
  for (const Ghost& ghost : ghosts) {
    const auto load = static_cast<std::size_t>(ghost.load);
    if (load >= ghost_begin_[cuts_[share]]) break;  // ghosts stand in the order of the tiles that they visit
    deferred_of(ghost) = 1;
    while (ghost_begin_[after] <= load) ++after;
  }
  in_time_[tile] = {};
  for (const Ghost& ghost : ghosts) (deferred_of(ghost) != 0 ? deferred_ : in_time_)[tile].ghosts.push_back(ghost);
  for (std::size_t begin = 0; begin < count; begin += together) {
    auto& places = (is_deferred[begin / together] != 0 ? deferred_ : in_time_)[tile].places;
    const std::size_t end = std::min(begin + together, count);
    if (!places.empty() && places.back().end == begin)
      places.back().end = end;
    else
      places.push_back({begin, end});
  }
  if (deferred_[tile].places.empty()) return;
  deferred_tiles_[share].push_back({tile, after});
  std::size_t deferred_count = 0;
  for (const PlaceRange& range : deferred_[tile].places) deferred_count += range.end - range.begin;
  deferred_loads_[tile].resize(deferred_count);
}

void LoadTable::clear_ghosts(std::size_t tile) {
  std::fill(ghosts_.end() - static_cast<std::ptrdiff_t>(ghost_begin_[tile + 1]),
            ghosts_.end() - static_cast<std::ptrdiff_t>(ghost_begin_[tile]), state::SphereLoad{});
}

void LoadTable::add(const std::vector<Ghost>& ghosts, state::SphereLoad* own) const {
  if (ghosts.empty()) return;
  constexpr std::size_t ahead = 16;  // ghosts come from many tiles: what they bring is on its way so many before
  const state::SphereLoad* const first = ghosts_.data() + ghosts_.size() - 1;
  for (std::size_t n = 0; n < ghosts.size(); ++n) {
    if (n + ahead < ghosts.size()) __builtin_prefetch(first - ghosts[n + ahead].load);
    const Ghost& ghost = ghosts[n];
    Real* const load = &own[ghost.local].fx;
    (Octet::load(load) + Octet::load(&(first - ghost.load)->fx)).store(load);
  }
}

void LoadTable::gather_in_time(std::size_t tile, state::SphereLoad* own) {
  auto kept = deferred_loads_[tile].begin();
  for (const PlaceRange& range : deferred_[tile].places) {
    kept = std::copy(own + range.begin, own + range.end, kept);
    std::fill(own + range.begin, own + range.end, state::SphereLoad{});
  }
  add(in_time_[tile].ghosts, own);
}

void LoadTable::gather_deferred(std::size_t tile, state::SphereLoad* own) const {
  auto kept = deferred_loads_[tile].begin();
  for (const PlaceRange& range : deferred_[tile].places) {
    const auto last = kept + static_cast<std::ptrdiff_t>(range.end - range.begin);
    std::copy(kept, last, own + range.begin);
    kept = last;
  }
  add(deferred_[tile].ghosts, own);
}

void LoadTable::columns(Archive& archive) {
  std::vector<state::SphereLoad> all;
  for (const auto& loads : kept_) all.insert(all.end(), loads.begin(), loads.end());
  archive("loads", all);
  if (!archive.reading()) return;
  for (std::size_t tile = 0; tile < tiles_; ++tile)
    std::copy(all.begin() + static_cast<std::ptrdiff_t>(begin_of(tile)), all.begin() + static_cast<std::ptrdiff_t>(end_of(tile)),
              kept(tile).begin());
}

}  // namespace sazare::methods::spheres
