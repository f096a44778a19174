#include "sazare/neighbors/pair_levels.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace sazare::neighbors {

namespace {

/// Calls f(i, j) for all pairs.
template <class F>
void visit(const SpherePairs& pairs, F&& f) {
  for (std::size_t i = 0; i + 1 < pairs.first.size(); ++i)
    for (std::size_t p = pairs.first[i]; p < pairs.first[i + 1]; ++p) f(i, static_cast<std::size_t>(pairs.other[p]));
}

/// Gives all spheres of a body the finest active level among them.
void keep_together(std::span<const Index> body, std::vector<std::int8_t>& active) {
  if (body.empty()) return;
  std::vector<std::int8_t> finest(static_cast<std::size_t>(std::ranges::max(body)) + 1, 0);
  const auto of_body = [&](std::size_t i) -> std::int8_t& { return finest[static_cast<std::size_t>(body[i])]; };
  for (std::size_t i = 0; i < body.size(); ++i)
    if (body[i] >= 0) of_body(i) = std::max(of_body(i), active[i]);
  for (std::size_t i = 0; i < body.size(); ++i)
    if (body[i] >= 0) active[i] = of_body(i);
}

}  // namespace

std::vector<std::int8_t> active_levels_of(const SpherePairs& pairs, const LevelsByPlace& levels) {
  std::vector<std::int8_t> active(levels.level.begin(), levels.level.end());
  const auto quicken = [&](std::size_t i, std::size_t j) {
    active[i] = std::max(active[i], levels.level[j]);
    active[j] = std::max(active[j], levels.level[i]);
  };
  visit(pairs, quicken);
  for (const auto& [one, other] : levels.bonded) quicken(static_cast<std::size_t>(one), static_cast<std::size_t>(other));
  keep_together(levels.body, active);
  return active;
}

namespace {

/// The pairs of each level, by the new places of their spheres.
std::vector<SpherePairs> split(const SpherePairs& all, std::span<const std::int8_t> level, const std::vector<Index>& place,
                               const std::vector<std::size_t>& spheres) {
  std::vector<SpherePairs> pairs(spheres.size());
  for (std::size_t l = 0; l < pairs.size(); ++l) pairs[l].first.assign(spheres[l] + 1, 0);
  const auto with_pair = [&](std::size_t i, std::size_t j, auto&& f) {
    f(pairs[static_cast<std::size_t>(std::max(level[i], level[j]))], static_cast<std::size_t>(std::min(place[i], place[j])),
      std::max(place[i], place[j]));
  };
  visit(all, [&](std::size_t i, std::size_t j) {
    with_pair(i, j, [](SpherePairs& of, std::size_t first, Index) { ++of.first[first + 1]; });
  });
  std::vector<std::vector<std::uint32_t>> next(pairs.size());
  for (std::size_t l = 0; l < pairs.size(); ++l) {
    std::partial_sum(pairs[l].first.begin(), pairs[l].first.end(), pairs[l].first.begin());
    pairs[l].other.resize(pairs[l].first.back());
    next[l] = pairs[l].first;
  }
  visit(all, [&](std::size_t i, std::size_t j) {
    with_pair(i, j, [&](SpherePairs& of, std::size_t first, Index second) {
      of.other[next[static_cast<std::size_t>(&of - pairs.data())][first]++] = second;
    });
  });
  for (SpherePairs& of : pairs)
    for (std::size_t i = 0; i + 1 < of.first.size(); ++i)
      std::sort(of.other.begin() + of.first[i], of.other.begin() + of.first[i + 1]);
  return pairs;
}

}  // namespace

std::vector<SpherePairs> split_by_level(const SpherePairs& all, std::span<const std::int8_t> level,
                                        const std::vector<std::size_t>& spheres) {
  std::vector<Index> same(level.size());
  std::iota(same.begin(), same.end(), 0);
  return split(all, level, same, spheres);
}

LeveledPairs find_leveled_pairs(const state::Spheres& spheres, Real margin, const LevelsByPlace& levels) {
  const SpherePairs all = find_pairs(spheres, margin);
  const std::vector<std::int8_t> active = active_levels_of(all, levels);
  LeveledPairs found;
  found.order = order_by_cell(spheres, margin);
  std::ranges::stable_sort(found.order, std::greater{}, [&](Index i) { return active[static_cast<std::size_t>(i)]; });
  found.spheres.assign(static_cast<std::size_t>(levels.finest) + 1, 0);
  for (const std::int8_t own : active)
    for (std::size_t l = 0; l <= static_cast<std::size_t>(own); ++l) ++found.spheres[l];
  found.pairs = split(all, levels.level, places_after(found.order), found.spheres);
  return found;
}

}  // namespace sazare::neighbors
