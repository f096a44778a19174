#pragma once

/// Who owns which chunk: by time level along the curve, by the graph of chunks, or at random.

#include <cstdint>
#include <vector>

#include "sazare/levels/distribute/chunk_work.hpp"

namespace sazare::distribute {

/// Whether this program can cut the graph of chunks: it is built with METIS. The second one throws UserError where it cannot.
bool has_graph_partition();
void require_graph_partition();

/// Every time level is cut evenly along the curve: a chunk counts for the level at which it has most to do.
std::vector<int> partition_by_level(const ChunkCosts& costs, int ranks);

/// METIS cuts the graph of chunks with few links between ranks, and shares out every time level evenly; where ranks would have
/// only a few chunks each, they are cut by level. Throws UserError where the program is built without METIS.
std::vector<int> partition_graph(const ChunkCosts& costs, const std::vector<ChunkBorder>& borders, int ranks);

/// Owners drawn at random, a trial of all that ranks tell each other.
std::vector<int> partition_at_random(Index chunks, int ranks, std::uint64_t seed);

/// The same parts under the numbers with which most bodies stay where they are. `now` and `next` are by chunk.
std::vector<int> keep_numbers(const std::vector<int>& now, const std::vector<int>& next, int ranks);

/// Owner of each body from that of its chunk, and the other way round by the chunk's first body.
Owners owners_of_bodies(const ChunkWork& work, const std::vector<int>& owner, int ranks);
std::vector<int> owners_of_chunks(const ChunkWork& work, const Owners& owners);

}  // namespace sazare::distribute
