#include "sazare/levels/distribute/partition.hpp"

#include <map>
#include <random>

namespace sazare::distribute {

namespace {

/// The level at which a chunk has most to do.
int main_level(const ChunkCosts& costs, Index chunk) {
  int best = 0;
  for (int level = 1; level < costs.levels(); ++level)
    if (costs.in_base_step(chunk, level) > costs.in_base_step(chunk, best)) best = level;
  return best;
}

}  // namespace

std::vector<int> partition_by_level(const ChunkCosts& costs, int ranks) {
  std::vector<std::vector<Index>> members(static_cast<std::size_t>(costs.levels()));
  for (Index chunk = 0; chunk < costs.chunks(); ++chunk)
    members[static_cast<std::size_t>(main_level(costs, chunk))].push_back(chunk);
  std::vector<int> owner(at(costs.chunks()), 0);
  for (const std::vector<Index>& chunks : members) {
    std::vector<Real> cost;
    for (const Index chunk : chunks) cost.push_back(costs.in_base_step(chunk));
    const Owners cut = cut_evenly(cost, ranks);
    for (std::size_t i = 0; i < chunks.size(); ++i) owner[at(chunks[i])] = cut.owner(static_cast<Index>(i));
  }
  return owner;
}

std::vector<int> partition_at_random(Index chunks, int ranks, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<int> owner(at(chunks));
  for (int& of : owner) of = static_cast<int>(random() % static_cast<std::uint64_t>(ranks));
  return owner;
}

/// Pairs of a part and a rank take each other, those that have most in common first; parts that are left take the ranks that are
/// left, in order.
std::vector<int> keep_numbers(const std::vector<int>& now, const std::vector<int>& next, int ranks) {
  std::map<std::pair<int, int>, Index> common;  // chunks by part and rank
  for (std::size_t chunk = 0; chunk < next.size(); ++chunk) ++common[{next[chunk], now[chunk]}];
  std::vector<std::pair<std::pair<int, int>, Index>> pairs(common.begin(), common.end());
  std::ranges::stable_sort(pairs, [](const auto& one, const auto& other) { return one.second > other.second; });
  constexpr int none = -1;
  std::vector<int> rank_of(static_cast<std::size_t>(ranks), none);
  std::vector<bool> taken(static_cast<std::size_t>(ranks), false);
  for (const auto& [pair, chunks] : pairs) {
    const auto part = static_cast<std::size_t>(pair.first), rank = static_cast<std::size_t>(pair.second);
    if (rank_of[part] != none || taken[rank]) continue;
    rank_of[part] = pair.second;
    taken[rank] = true;
  }
  std::size_t free = 0;
  for (int& rank : rank_of) {
    if (rank != none) continue;
    while (taken[free]) ++free;
    rank = static_cast<int>(free++);
  }
  std::vector<int> renamed(next.size());
  for (std::size_t chunk = 0; chunk < next.size(); ++chunk) renamed[chunk] = rank_of[static_cast<std::size_t>(next[chunk])];
  return renamed;
}

Owners owners_of_bodies(const ChunkWork& work, const std::vector<int>& owner, int ranks) {
  std::vector<int> of_body(at(work.bodies));
  for (Index body = 0; body < work.bodies; ++body) of_body[at(body)] = owner[at(work.chunk(body))];
  return {std::move(of_body), ranks};
}

std::vector<int> owners_of_chunks(const ChunkWork& work, const Owners& owners) {
  std::vector<int> of_chunk(at(work.chunks()));
  for (Index chunk = 0; chunk < work.chunks(); ++chunk) of_chunk[at(chunk)] = owners.owner(chunk * work.chunk_size);
  return of_chunk;
}

}  // namespace sazare::distribute
