#include "sazare/levels/distribute/chunk_work.hpp"

#include <numeric>

namespace sazare::distribute {

ChunkCosts::ChunkCosts(const ChunkWork& work, const std::vector<Real>& kind_cost) : chunks_(work.chunks()) {
  std::vector<Real> all(ChunkWork::place(chunks_, 0), 0);
  for (std::size_t kind = 0; kind < work.due.size(); ++kind)
    for (std::size_t place = 0; place < all.size(); ++place) all[place] += kind_cost[kind] * work.due[kind][place];
  for (Index chunk = 0; chunk < chunks_; ++chunk)
    for (int level = levels_; level < schedule::level_count; ++level)
      if (all[ChunkWork::place(chunk, level)] > 0) levels_ = level + 1;
  cost_.reserve(at(chunks_) * static_cast<std::size_t>(levels_));
  for (Index chunk = 0; chunk < chunks_; ++chunk)
    for (int level = 0; level < levels_; ++level) cost_.push_back(all[ChunkWork::place(chunk, level)]);
}

Real ChunkCosts::in_base_step(Index chunk) const {
  Real sum = 0;
  for (int level = 0; level < levels_; ++level) sum += in_base_step(chunk, level);
  return sum;
}

/// At a tick a level and all finer ones are due; each level has twice as many ticks of its own as the one before.
Real lock_step(const std::vector<std::vector<Real>>& at_step) {
  const std::size_t ranks = at_step.front().size();
  std::vector<Real> work(ranks, 0);
  Real mean = 0, largest = 0;
  for (std::size_t level = at_step.size(); level-- > 0;) {
    for (std::size_t rank = 0; rank < ranks; ++rank) work[rank] += at_step[level][rank];
    const auto ticks = static_cast<Real>(level == 0 ? 1 : Tick{1} << (level - 1));
    mean += ticks * std::accumulate(work.begin(), work.end(), Real{0}) / static_cast<Real>(ranks);
    largest += ticks * *std::ranges::max_element(work);
  }
  return largest > 0 ? mean / largest : 1;
}

Real lock_step(const ChunkCosts& costs, const std::vector<int>& owner, int ranks) {
  std::vector<std::vector<Real>> at_step(static_cast<std::size_t>(costs.levels()),
                                         std::vector<Real>(static_cast<std::size_t>(ranks), 0));
  for (Index chunk = 0; chunk < costs.chunks(); ++chunk)
    for (int level = 0; level < costs.levels(); ++level)
      at_step[static_cast<std::size_t>(level)][static_cast<std::size_t>(owner[at(chunk)])] += costs.at_step(chunk, level);
  return lock_step(at_step);
}

}  // namespace sazare::distribute
