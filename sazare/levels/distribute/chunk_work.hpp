#pragma once

/// What chunks of bodies have to do at every time level, and what they share with each other: what owners are chosen by.
///
/// All ranks meet at every tick, so a step takes as long as the rank with most to do at each tick, not as long as the rank
/// with most to do in all. A chunk is a number of bodies that follow each other along the curve on which they are stored.

#include <algorithm>
#include <vector>

#include "sazare/levels/distribute/owners.hpp"
#include "sazare/levels/schedule/levels.hpp"

namespace sazare::distribute {

/// Two chunks whose bodies are linked.
struct ChunkBorder {
  Index first = 0;
  Index second = 0;
  Real times = 0;  ///< how often links between them are due in a base step
};

struct ChunkWork {
  Index bodies = 0;
  Index chunk_size = 1;
  std::vector<std::vector<Real>> due;  ///< by kind of work: how much of it a chunk has at a step of a level, see `place`
  std::vector<ChunkBorder> borders;    ///< each pair once

  Index chunks() const { return (bodies + chunk_size - 1) / chunk_size; }
  Index chunk(Index body) const { return body / chunk_size; }
  static std::size_t place(Index chunk, int level) {
    return static_cast<std::size_t>(chunk) * schedule::level_count + static_cast<std::size_t>(level);
  }
};

/// Bodies of a chunk: 128, or fewer where ranks would have too few chunks to choose from.
inline Index chunk_size_for(Index bodies, int ranks) {
  constexpr Index largest = 128, smallest = 8, chunks_of_rank = 64;
  Index size = largest;
  while (size > smallest && size * chunks_of_rank * ranks > bodies) size /= 2;
  return size;
}

/// Work of chunks in one unit: what a step of each level takes of each.
class ChunkCosts {
public:
  /// With the cost of each kind of work.
  ChunkCosts(const ChunkWork& work, const std::vector<Real>& kind_cost);

  Index chunks() const { return chunks_; }
  int levels() const { return levels_; }
  Real at_step(Index chunk, int level) const {
    return cost_[static_cast<std::size_t>(chunk) * static_cast<std::size_t>(levels_) + static_cast<std::size_t>(level)];
  }
  /// Of a level, or of all, in a base step.
  Real in_base_step(Index chunk, int level) const { return at_step(chunk, level) * static_cast<Real>(Tick{1} << level); }
  Real in_base_step(Index chunk) const;

private:
  Index chunks_ = 0;
  int levels_ = 1;
  std::vector<Real> cost_;
};

/// Mean over the ranks of what they have to do at a tick over the largest of it, for all ticks of a base step together: 1 where
/// no rank ever waits for work of another one. By level, then rank: what a step of the level takes.
Real lock_step(const std::vector<std::vector<Real>>& at_step);
/// For owners by chunk.
Real lock_step(const ChunkCosts& costs, const std::vector<int>& owner, int ranks);

}  // namespace sazare::distribute
