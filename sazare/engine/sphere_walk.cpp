/// A step of spheres, block by block on several threads, each of which has a share of the blocks that stand one after the other.

#include <algorithm>
#include <utility>

#include "sazare/engine/block_shares.hpp"
#include "sazare/engine/sphere_stepper.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::engine {

/// Forces and kicks of all spheres.
void SphereStepper::walk() {
  parallel::Progress progress(share_seconds_.size());
  parallel::parallel_for(share_seconds_.size(), 2, [&](std::size_t begin, std::size_t end) {
    try {
      for (std::size_t share = begin; share < end; ++share) walk(share, progress);
    } catch (...) {
      progress.give_up();
      throw;
    }
  });
}

/// Forces and kicks of a share's blocks, each while it is in the cache; then of its spheres at which earlier shares look.
void SphereStepper::walk(std::size_t share, parallel::Progress& progress) {
  const Real began = parallel::processor_seconds();
  std::vector<state::SphereLoad> loads(neighbors::block_size);
  const std::size_t end = loads_.cuts()[share + 1];
  for (std::size_t block = loads_.cuts()[share]; block < end; ++block) {
    block_sums_[block] = evaluate(block, end, loads.data());
    progress.set(share, block + 1);
    loads_.gather_in_time(block, loads.data());
    speeds_[block] = move(block, loads_.places_in_time(block), loads.data());
  }
  const Real waited = kick_late(share, progress);
  share_seconds_[share] += parallel::processor_seconds() - began - waited;
}

/// Late spheres have left the cache since their block was evaluated: they are asked for while those before them are kicked.
void SphereStepper::ask_for_late(std::size_t block) const {
  for (const auto& range : loads_.late_places(block)) {
    const std::size_t begin = loads_.begin_of(block) + range.begin, count = range.end - range.begin;
    ComingLines lines;
    lines.add(std::span(spheres_.place).subspan(begin, count));
    lines.add(std::span(spheres_.spin).subspan(begin, count));
    lines.add(std::span(spheres_.kick).subspan(begin, count));
    lines.fetch(lines.lines());
  }
}

/// Each late block as soon as the blocks that look at it are evaluated. Returns how long that took to come [s].
Real SphereStepper::kick_late(std::size_t share, const parallel::Progress& progress) {
  Real waited = 0;
  std::vector<state::SphereLoad> loads(neighbors::block_size);
  const auto blocks = loads_.late_blocks(share);
  if (!blocks.empty()) ask_for_late(blocks.front().block);
  for (std::size_t n = 0; n < blocks.size(); ++n) {
    const auto [block, after] = blocks[n];
    if (n + 1 < blocks.size()) ask_for_late(blocks[n + 1].block);
    for (std::size_t earlier = 0; earlier < share; ++earlier) {
      const std::size_t until = std::min(after, loads_.cuts()[earlier + 1]);
      if (progress.has_come(earlier, until)) continue;
      const Real from = parallel::processor_seconds();
      if (!progress.wait(earlier, until)) return waited;
      waited += parallel::processor_seconds() - from;
    }
    loads_.gather_late(block, loads.data());
    speeds_[block].take(move(block, loads_.late_places(block), loads.data()));
  }
  return waited;
}

/// Cuts new lists of loads as they were cut before; evenly where there are none, or as many threads no more.
void SphereStepper::share_out() {
  std::vector<std::size_t> even = even_cuts(loads_.blocks(), static_cast<std::size_t>(parallel::threads()));
  if (cuts_.size() != even.size()) cuts_ = std::move(even);
  loads_.share_out(cuts_);
  share_seconds_.assign(cuts_.size() - 1, 0);
}

/// Cuts anew so that all threads have as much work.
void SphereStepper::balance() {
  std::vector<std::size_t> cuts = balanced_cuts(cuts_, share_seconds_);
  if (cuts != cuts_) loads_.share_out(cuts_ = std::move(cuts));
  std::ranges::fill(share_seconds_, 0);
}

}  // namespace sazare::engine
