/// The only source that knows METIS.

#include "sazare/core/error.hpp"
#include "sazare/core/saturated.hpp"
#include "sazare/levels/distribute/partition.hpp"

#if defined(SAZARE_METIS)
#include <metis.h>
#endif

namespace sazare::distribute {

#if defined(SAZARE_METIS)

namespace {

constexpr Real least_share = 0.02;       // of all work: what has less has no constraint of its own
constexpr Real tolerated_excess = 1.02;  // of the largest part over the mean, for every constraint
constexpr Real largest_sum = 1e8;        // of weights, which METIS adds up in 32 bits
constexpr Index fewest_chunks = 4;       // per rank: with fewer METIS leaves ranks without any
constexpr int few_parts = 8;             // for which METIS's manual advises to cut in halves

/// Levels whose work is balanced together: each has a share of all work that is worth it. By level, the number of its group.
std::vector<std::size_t> group_levels(const ChunkCosts& costs) {
  std::vector<Real> sums(static_cast<std::size_t>(costs.levels()), 0);
  Real total = 0;
  for (Index chunk = 0; chunk < costs.chunks(); ++chunk)
    for (int level = 0; level < costs.levels(); ++level) {
      sums[static_cast<std::size_t>(level)] += costs.in_base_step(chunk, level);
      total += costs.in_base_step(chunk, level);
    }
  std::vector<std::size_t> group(sums.size(), 0);
  std::size_t now = 0;
  Real in_group = 0, left = total;
  for (std::size_t level = sums.size(); level-- > 0;) {
    group[level] = now;
    in_group += sums[level];
    left -= sums[level];
    if (in_group < least_share * total || left < least_share * total) continue;
    ++now;
    in_group = 0;
  }
  return group;
}

/// Work of each chunk by group of levels, in whole numbers.
std::vector<idx_t> vertex_weights(const ChunkCosts& costs, const std::vector<std::size_t>& group, std::size_t groups) {
  std::vector<Real> work(at(costs.chunks()) * groups, 0), sums(groups, 0);
  for (Index chunk = 0; chunk < costs.chunks(); ++chunk)
    for (int level = 0; level < costs.levels(); ++level) {
      const std::size_t of = group[static_cast<std::size_t>(level)];
      work[at(chunk) * groups + of] += costs.in_base_step(chunk, level);
      sums[of] += costs.in_base_step(chunk, level);
    }
  std::vector<idx_t> weights(work.size());
  for (std::size_t i = 0; i < work.size(); ++i)
    weights[i] = static_cast<idx_t>(sums[i % groups] > 0 ? largest_sum * work[i] / sums[i % groups] : 1);
  return weights;
}

/// The borders of each chunk with all others, one chunk after the other.
struct Graph {
  std::vector<idx_t> begin, neighbor, weight;

  Graph(Index chunks, const std::vector<ChunkBorder>& borders) : begin(at(chunks) + 1, 0) {
    Real total = 0;
    for (const ChunkBorder& border : borders) {
      ++begin[at(border.first) + 1];
      ++begin[at(border.second) + 1];
      total += 2 * border.times;
    }
    for (std::size_t chunk = 1; chunk < begin.size(); ++chunk) begin[chunk] += begin[chunk - 1];
    neighbor.resize(static_cast<std::size_t>(begin.back()));
    weight.resize(neighbor.size());
    std::vector<idx_t> next(begin.begin(), begin.end() - 1);
    const auto add = [&](Index from, Index to, Real times) {
      const auto place = static_cast<std::size_t>(next[at(from)]++);
      neighbor[place] = to;
      weight[place] = std::max<idx_t>(1, saturated<idx_t>(largest_sum * times / total));
    };
    for (const ChunkBorder& border : borders) {
      add(border.first, border.second, border.times);
      add(border.second, border.first, border.times);
    }
  }
};

}  // namespace

bool has_graph_partition() { return true; }

void require_graph_partition() {}

std::vector<int> partition_graph(const ChunkCosts& costs, const std::vector<ChunkBorder>& borders, int ranks) {
  if (costs.chunks() < fewest_chunks * ranks) return partition_by_level(costs, ranks);
  const std::vector<std::size_t> group = group_levels(costs);
  const std::size_t groups = *std::ranges::max_element(group) + 1;
  std::vector<idx_t> weights = vertex_weights(costs, group, groups);
  Graph graph(costs.chunks(), borders);
  idx_t vertices = costs.chunks(), constraints = static_cast<idx_t>(groups), parts = ranks, cut = 0;
  std::vector<real_t> excess(groups, static_cast<real_t>(tolerated_excess));
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> part(at(costs.chunks()), 0);
  const auto partition = ranks <= few_parts ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int answer = partition(&vertices, &constraints, graph.begin.data(), graph.neighbor.data(), weights.data(), nullptr,
                               graph.weight.data(), &parts, nullptr, excess.data(), options.data(), &cut, part.data());
  if (answer != METIS_OK)
    throw MachineError("METIS could not distribute the elements over the ranks; --balance by_level does without it");
  return {part.begin(), part.end()};
}

#else

bool has_graph_partition() { return false; }

void require_graph_partition() {
  throw UserError(
      "--balance graph needs METIS, without which this sazare is built: take --balance by_level, or install libmetis-dev and "
      "build "
      "it again");
}

std::vector<int> partition_graph(const ChunkCosts&, const std::vector<ChunkBorder>&, int) {
  require_graph_partition();
  return {};
}

#endif

}  // namespace sazare::distribute
