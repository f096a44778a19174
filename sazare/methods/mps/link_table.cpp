#include "sazare/methods/mps/link_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace sazare::methods::mps {

namespace {

/// Offsets of the lattice shorter than `influence`, in lexicographic order.
template <int D>
std::vector<Site<D>> offsets_within(Real influence) {
  const int reach = static_cast<int>(std::floor(influence));
  const int width = 2 * reach + 1;
  int count = 1;
  for (int i = 0; i < D; ++i) count *= width;
  std::vector<Site<D>> offsets;
  for (int number = 0; number < count; ++number) {
    Site<D> offset;
    int rest = number, square = 0;
    for (int i = D - 1; i >= 0; --i, rest /= width) {
      offset[static_cast<std::size_t>(i)] = rest % width - reach;
      square += offset[static_cast<std::size_t>(i)] * offset[static_cast<std::size_t>(i)];
    }
    if (square > 0 && square < influence * influence) offsets.push_back(offset);
  }
  return offsets;
}

template <int D>
Real length_of(const Site<D>& offset) {
  return std::sqrt(static_cast<Real>(std::inner_product(offset.begin(), offset.end(), offset.begin(), 0)));
}

template <int D>
laws::LinkDirection<D> make_direction(const Site<D>& offset, Real spacing, Real influence, Real number_density) {
  laws::LinkDirection<D> law;
  const Real length = length_of<D>(offset) * spacing, weight = laws::link_weight(length_of<D>(offset), influence);
  const Real volume = std::pow(spacing, D);
  for (int i = 0; i < D; ++i) law.start[i] = offset[static_cast<std::size_t>(i)] * spacing;
  law.spring = 4 * D * volume * weight / (number_density * length * length);
  law.divergence = D * weight / (number_density * length);
  return law;
}

/// Finds where the neighbours of a pack stand in a row.
template <class Direction>
void find_rows(Direction& direction) {
  const std::size_t packs = direction.neighbor.size() / lane_count;
  direction.first.assign(packs, -1);
  for (std::size_t pack = 0; pack < packs; ++pack) {
    const Index* neighbors = &direction.neighbor[pack * lane_count];
    bool in_a_row = true;
    for (int lane = 0; lane < lane_count; ++lane) in_a_row = in_a_row && neighbors[lane] == neighbors[0] + lane;
    if (in_a_row) direction.first[pack] = neighbors[0];
  }
}

}  // namespace

template <int D>
void LinkTable<D>::set_share(std::size_t direction, Index particle, Real share) {
  Index& pattern = directions[direction].pattern[static_cast<std::size_t>(particle / lane_count)];
  auto shares = patterns[static_cast<std::size_t>(pattern)].share;
  shares[static_cast<std::size_t>(particle % lane_count)] = share;
  if (known_.empty()) known_[patterns.front().share] = 0;
  const auto [found, is_new] = known_.try_emplace(shares, static_cast<Index>(patterns.size()));
  if (is_new) {
    patterns.emplace_back().share = shares;
    for (std::size_t lane = 0; lane < lane_count; ++lane) patterns.back().lanes[lane] = shares[lane];
  }
  pattern = found->second;
}

template <int D>
void LinkTable<D>::halve_among(std::span<const Index> particles) {
  const std::set<Index> members(particles.begin(), particles.end());
  for (std::size_t direction = 0; direction < directions.size(); ++direction)
    for (const Index particle : members)
      if (is_present(direction, particle) && members.contains(directions[direction].neighbor[static_cast<std::size_t>(particle)]))
        set_share(direction, particle, 0.5 * share(direction, particle));
}

template <int D>
LinkTable<D> make_links(std::span<const Site<D>> sites, Real spacing, Real influence, const Site<D>& period) {
  LinkTable<D> table;
  table.patterns.emplace_back();
  const std::vector<Site<D>> offsets = offsets_within<D>(influence);
  for (const Site<D>& offset : offsets) table.number_density += laws::link_weight(length_of<D>(offset), influence);
  std::map<Site<D>, Index> particle_at;
  for (std::size_t i = 0; i < sites.size(); ++i) particle_at[sites[i]] = static_cast<Index>(i);
  const std::size_t padded = (sites.size() + lane_count - 1) / lane_count * lane_count;
  for (const Site<D>& offset : offsets) {
    auto& direction = table.directions.emplace_back();
    direction.offset = offset;
    direction.law = make_direction<D>(offset, spacing, influence, table.number_density);
    direction.neighbor.resize(padded);
    std::iota(direction.neighbor.begin(), direction.neighbor.end(), 0);
    direction.pattern.assign(padded / lane_count, 0);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      Site<D> site = sites[i];
      for (std::size_t axis = 0; axis < D; ++axis) {
        site[axis] += offset[axis];
        if (period[axis] > 0) site[axis] = (site[axis] + period[axis]) % period[axis];
      }
      const auto found = particle_at.find(site);
      if (found == particle_at.end()) continue;
      direction.neighbor[i] = found->second;
      table.set_share(table.directions.size() - 1, static_cast<Index>(i), 1);
    }
    find_rows(direction);
  }
  return table;
}

template struct LinkTable<2>;
template struct LinkTable<3>;
template LinkTable<2> make_links<2>(std::span<const Site<2>>, Real, Real, const Site<2>&);
template LinkTable<3> make_links<3>(std::span<const Site<3>>, Real, Real, const Site<3>&);

}  // namespace sazare::methods::mps
