#include "sazare/neighbors/sphere_pairs.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <span>
#include <utility>

#include "sazare/core/lane_records.hpp"
#include "sazare/neighbors/sphere_cells.hpp"
#include "sazare/parallel/sort.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/state/box_lanes.hpp"

namespace sazare::neighbors {

namespace {

/// Spheres of one class in a cell and around it, one after the other.
class Around {
public:
  /// Where all are of one class and stand in order those of earlier cells may be left out: they look at this one.
  void move_to(const SphereCells& cells, const Vector3& centre, bool leaves_out_earlier) {
    const CellPlace now = cells.grid.place_of(centre);
    if (now == place_) return;
    place_ = now;
    spheres_.clear();
    const std::uint64_t earliest = leaves_out_earlier ? cells.grid.key(now) : 0;
    cells.grid.around(now, [&](std::uint64_t key) {
      if (key < earliest) return;
      const auto range = cells.at(key);
      for (std::uint32_t n = range.begin; n < range.end; ++n) spheres_.push_back(cells.items[n]);
    });
    count_ = spheres_.size();
    if (count_ > 0) spheres_.resize(count_ + lane_count, spheres_.back());
  }

  /// Finds the spheres nearer to a sphere than the margin: the first entries of `near`, as many as it returns.
  std::size_t find_near(const state::Spheres& spheres, const state::BoxLanes<Lanes>& box, const state::SpherePlace& own,
                        Real margin, std::vector<Index>& near) const {
    if (near.size() < count_ + lane_count) near.resize(count_ + lane_count);
    const LaneVector centre{broadcast(own.x), broadcast(own.y), broadcast(own.z)};
    const Lanes least_reach = broadcast(own.radius + margin);
    std::size_t found = 0;
    for (std::size_t n = 0; n < count_; n += lane_count) {
      const Index* const some = &spheres_[n];
      const auto other = load_quads([&](std::size_t lane) { return &spheres.place[static_cast<std::size_t>(some[lane])].x; });
      LaneVector apart{other[0] - centre[0], other[1] - centre[1], other[2] - centre[2]};
      const Lanes reach = least_reach + other[3];
      unsigned bits = those_above(reach * reach, box.square_of_nearest(apart));
      if (count_ - n < lane_count) bits &= (1u << (count_ - n)) - 1;
      for (std::size_t lane = 0; lane < lane_count; ++lane) {  // without a branch: nobody foretells which are near
        near[found] = some[lane];
        found += bits >> lane & 1;
      }
    }
    return found;
  }

private:
  CellPlace place_{-1, -1, -1};
  std::vector<Index> spheres_;  ///< the last one again, to whole lanes
  std::size_t count_ = 0;
};

/// Looks for pairs in the size classes of a body.
class Search {
public:
  /// `known`: places of spheres in order; all where there are none.
  Search(const state::Spheres& spheres, Real margin, std::span<const std::uint8_t> is_wanted, const SphereSizes& sizes,
         std::span<const Index> known)
      : spheres_(spheres), margin_(margin), is_wanted_(is_wanted), sizes_(sizes), known_(known), box_(spheres.box) {
    std::array<std::vector<Index>, SphereSizes::most_classes> members;
    visit_known(0, spheres.size(), [&](std::size_t i) { members[class_of(i)].push_back(static_cast<Index>(i)); });
    for (std::size_t c = 0; c < members.size(); ++c) {
      number_[c] = cells_.size();
      if (!(sizes.radius[c] > 0)) continue;
      cells_.emplace_back(CellGrid(spheres.box, sizes, 2 * sizes.radius[c] + margin), spheres, members[c]);
      members[c] = {};
    }
  }

  SpherePairs run() {
    const std::size_t tiles = tiles_of(spheres_.size());
    std::vector<Tile> found(tiles);
    parallel::parallel_for_uneven(tiles, 2, [&](std::size_t begin, std::size_t end) {
      std::vector<Around> around(cells_.size());
      for (std::size_t tile = begin; tile < end; ++tile) look(tile, around, found[tile]);
    });
    std::vector<std::pair<Index, Index>> mixed;  // pairs of two classes, by first sphere
    for (Tile& tile : found) {
      mixed.insert(mixed.end(), tile.mixed.begin(), tile.mixed.end());
      tile.mixed = {};
    }
    std::erase_if(mixed, [&](const auto& pair) { return !is_wanted(static_cast<std::size_t>(pair.first) / tile_size); });
    parallel::sort(mixed);
    cells_.clear();
    return join(std::move(found), mixed);
  }

private:
  struct Tile {
    std::vector<std::uint32_t> counts;
    std::vector<Index> other;
    std::vector<std::pair<Index, Index>> mixed;
  };

  std::size_t class_of(std::size_t sphere) const { return sizes_.class_of(spheres_.place[sphere].radius); }
  /// Calls visit(i) for the known spheres from a place on to before another.
  template <class Visit>
  void visit_known(std::size_t begin, std::size_t end, Visit&& visit) const {
    if (known_.empty())
      for (std::size_t i = begin; i < end; ++i) visit(i);
    for (auto i = std::ranges::lower_bound(known_, static_cast<Index>(begin)); i != known_.end() && *i < static_cast<Index>(end);
         ++i)
      visit(static_cast<std::size_t>(*i));
  }
  bool is_wanted(std::size_t tile) const { return is_wanted_.empty() || is_wanted_[tile] != 0; }

  /// A tile that is not wanted may have small spheres beside larger ones of one that is.
  void look(std::size_t number, std::vector<Around>& around, Tile& tile) const {
    std::vector<Index> near;
    const std::size_t begin = number * tile_size, end = std::min(begin + tile_size, spheres_.size());
    tile.counts.resize(end - begin, 0);
    if (!is_wanted(number) && cells_.size() == 1) return;
    visit_known(begin, end, [&](std::size_t i) {
      const auto& own = spheres_.place[i];
      const auto sphere = static_cast<Index>(i);
      const std::size_t before = tile.other.size(), own_class = number_[class_of(i)];
      for (std::size_t c = 0; c <= own_class; ++c) {
        around[c].move_to(cells_[c], own.centre(), cells_.size() == 1 && cells_[c].stands_in_order);
        const std::size_t count = around[c].find_near(spheres_, box_, own, margin_, near);  // which moves what it enlarges
        const std::span found(near.data(), count);
        if (c == own_class && !is_wanted(number)) continue;
        if (c == own_class)
          std::ranges::copy_if(found, std::back_inserter(tile.other), [&](Index j) { return j > sphere; });
        else
          for (const Index j : found) tile.mixed.emplace_back(std::min(sphere, j), std::max(sphere, j));
      }
      tile.counts[i - begin] = static_cast<std::uint32_t>(tile.other.size() - before);
    });
  }

  /// One list of what the tiles have found, which is given up on the way.
  SpherePairs join(std::vector<Tile> found, const std::vector<std::pair<Index, Index>>& mixed) const {
    SpherePairs pairs;
    pairs.first.reserve(spheres_.size() + 1);
    pairs.first.push_back(0);
    std::size_t total = mixed.size();
    for (const Tile& tile : found) total += tile.other.size();
    pairs.other.reserve(total);
    auto next = mixed.begin();
    for (Tile& tile : found) {
      auto from = tile.other.begin();
      for (const std::uint32_t count : tile.counts) {
        const auto i = static_cast<Index>(pairs.first.size() - 1);
        pairs.other.insert(pairs.other.end(), from, from + count);
        from += count;
        for (; next != mixed.end() && next->first == i; ++next) pairs.other.push_back(next->second);
        pairs.first.push_back(static_cast<std::uint32_t>(pairs.other.size()));
      }
      tile = {};
    }
    return pairs;
  }

  const state::Spheres& spheres_;
  Real margin_;
  std::span<const std::uint8_t> is_wanted_;
  const SphereSizes& sizes_;
  std::span<const Index> known_;
  state::BoxLanes<Lanes> box_;
  std::array<std::size_t, SphereSizes::most_classes> number_{};  ///< of a class in `cells_`
  std::vector<SphereCells> cells_;                               ///< of the classes that are not empty, largest spheres first
};

/// The n-th record becomes what order[n] was. In place, circle by circle: a copy would be the most that a search needs.
template <class T>
void permute(std::vector<T>& records, const std::vector<Index>& order) {
  std::vector<bool> done(records.size());
  for (std::size_t first = 0; first < records.size(); ++first) {
    if (done[first]) continue;
    const T kept = records[first];
    std::size_t to = first;
    for (auto from = static_cast<std::size_t>(order[to]); from != first; from = static_cast<std::size_t>(order[to])) {
      records[to] = records[from];
      done[to] = true;
      to = from;
    }
    records[to] = kept;
    done[to] = true;
  }
}

}  // namespace

CellGrid order_grid(const state::PeriodicBox& box, const SphereSizes& sizes, Real margin) {
  return {box, sizes, 2 * sizes.smallest() + margin};
}

std::vector<Index> order_by_cell(const state::Spheres& spheres, Real margin) {
  const CellGrid grid = order_grid(spheres.box, SphereSizes(spheres), margin);
  std::vector<std::pair<std::uint64_t, Index>> keyed(spheres.size());
  parallel::parallel_for(spheres.size(), 20000, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      keyed[i] = {grid.key(grid.place_of(spheres.place[i].centre())), static_cast<Index>(i)};
  });
  parallel::sort(keyed);
  std::vector<Index> order(keyed.size());
  for (std::size_t n = 0; n < keyed.size(); ++n) order[n] = keyed[n].second;
  return order;
}

std::vector<Index> places_after(const std::vector<Index>& order) {
  std::vector<Index> place(order.size());
  for (std::size_t n = 0; n < order.size(); ++n) place[static_cast<std::size_t>(order[n])] = static_cast<Index>(n);
  return place;
}

void put_in_order(state::Spheres& spheres, const std::vector<Index>& order) {
  const std::array<std::function<void()>, 5> columns{
      [&] { permute(spheres.place, order); }, [&] { permute(spheres.kick, order); }, [&] { permute(spheres.spin, order); },
      [&] { permute(spheres.turn, order); }, [&] { permute(spheres.number, order); }};
  parallel::parallel_for_uneven(columns.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t column = begin; column < end; ++column) columns[column]();
  });
}

void keep_wanted(SpherePairs& pairs, std::span<const std::uint8_t> is_wanted) {
  std::uint32_t kept = 0;
  for (std::size_t i = 0, from = 0; i + 1 < pairs.first.size(); ++i) {
    const std::size_t to = pairs.first[i + 1];
    pairs.first[i] = kept;
    for (; from < to; ++from)
      if (is_wanted[i / tile_size] != 0) pairs.other[kept++] = pairs.other[from];
  }
  if (!pairs.first.empty()) pairs.first.back() = kept;
  pairs.other.resize(kept);
}

SpherePairs find_pairs(const state::Spheres& spheres, Real margin, std::span<const std::uint8_t> is_wanted) {
  return Search(spheres, margin, is_wanted, SphereSizes(spheres), {}).run();
}

SpherePairs find_pairs(const state::Spheres& spheres, Real margin, std::span<const std::uint8_t> is_wanted,
                       const KnownSpheres& known) {
  if (known.places.empty()) return {std::vector<std::uint32_t>(spheres.size() + 1, 0), {}};
  return Search(spheres, margin, is_wanted, known.sizes, known.places).run();
}

}  // namespace sazare::neighbors
