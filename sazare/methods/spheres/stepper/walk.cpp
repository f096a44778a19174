/// A step of spheres that all take one, tile by tile on several threads, each of which has a share of the tiles that stand one
/// after the other.

#include <algorithm>
#include <numeric>
#include <utility>

#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

/// A clump waits for the forces on all its spheres; and where a body parts, its pieces push beyond the overlap that they had when
/// forces were evaluated, before any sphere moved.
bool SphereStepper::can_walk() const {
  return levels_.is_one() && clumps_.empty() && bodies_.empty() && ranks_ == nullptr && !evaluated_;
}

/// Forces and kicks of all spheres. Returns their speeds.
SphereSpeeds SphereStepper::walk() {
  const std::size_t tiles = levels_.loads(0).tiles();
  speeds_.resize(tiles);
  if (drives_) driven_work_.resize(spheres_.size() / methods::spheres::LoadTable::together + 1);
  walls_.move(time());
  const std::size_t shares = share_seconds_.size();
  parallel::Progress progress(shares);
  NextDeferred next_deferred(shares);
  parallel::parallel_for(shares, 2, [&](std::size_t begin, std::size_t end) {
    try {
      for (std::size_t share = begin; share < end; ++share) walk(share, progress);
      for (std::size_t n = 0; n < shares; ++n) kick_deferred((begin + n) % shares, progress, next_deferred);
    } catch (...) {
      progress.give_up();
      throw;
    }
  });
  levels_.count_contacts(0);
  levels_.count_kicks(spheres_.size());
  add_work(0);
  if (drives_) add_work_of_driven();
  SphereSpeeds all;
  for (const SphereSpeeds& one : speeds_) all.take(one);
  return all;
}

/// Moves the spheres at some places of a tile.
SphereSpeeds SphereStepper::move(std::size_t tile, std::span<const methods::spheres::PlaceRange> places,
                                 state::SphereLoad* loads) {
  SphereSpeeds speeds;
  const std::size_t first = levels_.loads(0).begin_of(tile);
  for (const auto& range : places) {
    const std::size_t begin = first + range.begin, end = first + range.end;
    if (drives_) find_work_of_driven(begin, end, loads + range.begin);
    speeds.take(kick_and_drift(spheres_, begin, end, loads + range.begin, {rules_.step, rules_.gravity, drift_}));
    if (!spheres_.turn.empty()) turn(spheres_, begin, end, rules_.step);
  }
  return speeds;
}

/// The work on driven spheres, in groups whose sums are the same however tiles are cut.
void SphereStepper::find_work_of_driven(std::size_t begin, std::size_t end, const state::SphereLoad* loads) {
  constexpr std::size_t together = methods::spheres::LoadTable::together;
  for (std::size_t first = begin; first < end; first += together)
    driven_work_[first / together] =
        work_of_driven(spheres_, first, std::min(first + together, end), loads + (first - begin), rules_.step);
}

/// Adds the work of the last walk on driven spheres, added up tile by tile as `SphereLevels::kick` does.
void SphereStepper::add_work_of_driven() {
  constexpr std::size_t of_tile = neighbors::tile_size / methods::spheres::LoadTable::together;
  for (std::size_t begin = 0; begin < driven_work_.size(); begin += of_tile) {
    const auto first = driven_work_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto count = static_cast<std::ptrdiff_t>(std::min(of_tile, driven_work_.size() - begin));
    works_.wall_work += std::accumulate(first, first + count, Real{0});
  }
}

/// What a tile's contacts and its kick will need.
ComingLines SphereStepper::coming(std::size_t tile) const {
  const auto& loads = levels_.loads(0);
  const std::size_t begin = loads.begin_of(tile), count = loads.end_of(tile) - begin;
  ComingLines coming = levels_.coming(spheres_, tile);
  coming.add_row(std::span(spheres_.kick).subspan(begin, count));
  return coming;
}

/// Forces and kicks of a share's tiles, each while it is in the cache.
void SphereStepper::walk(std::size_t share, parallel::Progress& progress) {
  const Real began = parallel::processor_seconds();
  progress.begin(share);
  std::vector<state::SphereLoad> loads(neighbors::tile_size);
  methods::spheres::LoadTable& table = levels_.loads(0);
  SphereLevels::Scene scene = this->scene(0);
  scene.tells_energies = false;  // whoever asks evaluates first
  const std::size_t end = cuts_[share + 1];
  for (std::size_t tile = cuts_[share]; tile < end; ++tile) {
    levels_.evaluate_tile(tile, scene, loads.data(), tile + 1 < end ? coming(tile + 1) : ComingLines{});
    progress.set(share, tile + 1);
    table.gather_in_time(tile, loads.data());
    speeds_[tile] = move(tile, table.places_in_time(tile), loads.data());
  }
  progress.set(share, end + 1);  // and has moved its spheres
  share_seconds_[share] += parallel::processor_seconds() - began;
}

/// Deferred spheres have left the cache since their tile was evaluated: they are asked for while those before them are kicked.
void SphereStepper::ask_for_deferred(std::size_t tile) const {
  const auto& table = levels_.loads(0);
  for (const auto& range : table.deferred_places(tile)) {
    const std::size_t begin = table.begin_of(tile) + range.begin, count = range.end - range.begin;
    ComingLines lines;
    lines.add(std::span(spheres_.place).subspan(begin, count));
    lines.add(std::span(spheres_.spin).subspan(begin, count));
    lines.add(std::span(spheres_.kick).subspan(begin, count));
    lines.fetch(lines.lines());
  }
}

/// Deferred tiles of a share that has moved its other spheres, each as soon as those that look at it are evaluated. All threads
/// that have done their own shares come and take what is next. A share that nobody has begun is left to who will: it may be a
/// thread that waits for this one to end, where there are fewer than shares.
void SphereStepper::kick_deferred(std::size_t share, const parallel::Progress& progress, NextDeferred& next_deferred) {
  const auto& table = levels_.loads(0);
  const auto tiles = table.deferred_tiles(share);
  const auto take = [&] {
    const std::size_t n = next_deferred[share]++;
    if (n < tiles.size()) ask_for_deferred(tiles[n].tile);
    return n;
  };
  if (tiles.empty() || !progress.has_begun(share) || !progress.wait(share, cuts_[share + 1] + 1)) return;
  std::size_t n = take();
  if (n >= tiles.size()) return;
  std::vector<state::SphereLoad> loads(neighbors::tile_size);
  for (std::size_t following; n < tiles.size(); n = following) {
    following = take();
    const auto [tile, after] = tiles[n];
    for (std::size_t earlier = 0; earlier < share; ++earlier)
      if (!progress.wait(earlier, std::min(after, cuts_[earlier + 1]))) return;
    table.gather_deferred(tile, loads.data());
    speeds_[tile].take(move(tile, table.deferred_places(tile), loads.data()));
  }
}

/// Cuts new lists of loads as they were cut before; evenly where there are none, or as many threads no more. With several levels
/// no one walks, and nothing is cut.
void SphereStepper::share_out() {
  if (!levels_.is_one()) return;
  std::vector<std::size_t> even = even_cuts(levels_.loads(0).tiles(), static_cast<std::size_t>(parallel::threads()));
  if (cuts_.size() != even.size()) cuts_ = std::move(even);
  levels_.loads(0).share_out(cuts_);
  share_seconds_.assign(cuts_.size() - 1, 0);
}

/// Cuts anew where threads have not as much work.
void SphereStepper::balance() {
  if (!levels_.is_one()) return;
  tile_costs_.learn(cuts_, share_seconds_);
  std::vector<std::size_t> cuts = tile_costs_.improved(cuts_);
  if (cuts != cuts_) levels_.loads(0).share_out(cuts_ = std::move(cuts));
  std::ranges::fill(share_seconds_, 0);
}

}  // namespace sazare::methods::spheres
