#include "sazare/neighbors/sphere_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sazare/parallel/threads.hpp"

namespace sazare::neighbors {

namespace {

constexpr int bits = 20;  // of a cell's place on an axis
constexpr int most_classes = 16;

/// A number's bits, with two free places after each.
std::uint64_t spread(std::uint64_t number) {
  number = (number | number << 32) & 0x1f00000000ffffULL;
  number = (number | number << 16) & 0x1f0000ff0000ffULL;
  number = (number | number << 8) & 0x100f00f00f00f00fULL;
  number = (number | number << 4) & 0x10c30c30c30c30c3ULL;
  return (number | number << 2) & 0x1249249249249249ULL;
}

using Place = std::array<std::int64_t, 3>;

/// Cells of one width over all space; along periodic axes a whole number of them.
struct Grid {
  Vector3 lower, width;
  Place count;  ///< along periodic axes, else 0
  state::PeriodicBox box;

  Grid(const state::PeriodicBox& of, const Vector3& low, Real least_width) : lower(low), box(of) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const Real length = of.length[axis];
      count[a] = length > 0 ? std::max<std::int64_t>(1, static_cast<std::int64_t>(length / least_width)) : 0;
      width[axis] = length > 0 ? length / static_cast<Real>(count[a]) : least_width;
      if (length > 0) lower[axis] = of.lower[axis];
    }
  }

  Place place_of(const Vector3& centre) const {
    const Vector3 at = box.wrapped(centre);
    Place place;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const std::int64_t most = count[a] > 0 ? count[a] - 1 : (std::int64_t{1} << bits) - 1;
      // Far away spheres share the last cell: slow, and right.
      place[a] = static_cast<std::int64_t>(std::clamp((at[axis] - lower[axis]) / width[axis], Real{0}, static_cast<Real>(most)));
    }
    return place;
  }

  static std::uint64_t key(const Place& place) {
    return spread(static_cast<std::uint64_t>(place[0])) | spread(static_cast<std::uint64_t>(place[1])) << 1 |
           spread(static_cast<std::uint64_t>(place[2])) << 2;
  }

  /// Keys of the cell and its neighbours, each once.
  std::vector<std::uint64_t> around(const Place& place) const {
    std::array<std::vector<std::int64_t>, 3> along;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::int64_t at = place[a] - 1; at <= place[a] + 1; ++at) {
        if (count[a] > 0)
          along[a].push_back((at + count[a]) % count[a]);
        else if (at >= 0 && at < std::int64_t{1} << bits)
          along[a].push_back(at);
      }
      std::ranges::sort(along[a]);
      along[a].erase(std::unique(along[a].begin(), along[a].end()), along[a].end());
    }
    std::vector<std::uint64_t> keys;
    for (const std::int64_t z : along[2])
      for (const std::int64_t y : along[1])
        for (const std::int64_t x : along[0]) keys.push_back(key({x, y, z}));
    return keys;
  }
};

/// Spheres of one size class by cell.
class Cells {
public:
  struct Range {
    std::uint32_t begin = 0, end = 0;
  };

  explicit Cells(Grid of) : grid(std::move(of)) {}

  void fill(const state::Spheres& spheres, const std::vector<Index>& members) {
    std::vector<std::pair<std::uint64_t, Index>> keyed(members.size());
    parallel::parallel_for(members.size(), 20000, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n)
        keyed[n] = {Grid::key(grid.place_of(spheres.place[static_cast<std::size_t>(members[n])].centre())), members[n]};
    });
    if (!std::ranges::is_sorted(keyed)) std::ranges::sort(keyed);  // spheres of one size stand along the curve already
    items.resize(keyed.size());
    std::size_t cells = 1, size = 16;
    for (std::size_t n = 1; n < keyed.size(); ++n) cells += keyed[n].first != keyed[n - 1].first ? 1 : 0;
    while (2 * size < 3 * cells) size *= 2;
    table_.assign(size, {});
    for (std::uint32_t begin = 0; begin < keyed.size();) {
      std::uint32_t end = begin;
      for (; end < keyed.size() && keyed[end].first == keyed[begin].first; ++end) items[end] = keyed[end].second;
      Entry& entry = table_[find(keyed[begin].first)];
      entry = {keyed[begin].first, {begin, end}};
      begin = end;
    }
  }

  Range at(std::uint64_t key) const { return table_[find(key)].range; }

  Grid grid;
  std::vector<Index> items;

private:
  struct Entry {
    std::uint64_t key = 0;
    Range range;
  };

  std::size_t find(std::uint64_t key) const {
    std::size_t at = (key * 0x9E3779B97F4A7C15ULL >> 20) & (table_.size() - 1);
    while (table_[at].range.end > 0 && table_[at].key != key) at = (at + 1) & (table_.size() - 1);
    return at;
  }

  std::vector<Entry> table_;
};

/// Which size class: 0 for the largest spheres, each further one for half the radius.
int class_of(Real radius, Real largest) {
  return std::clamp(static_cast<int>(std::floor(std::log2(largest / radius) + 1e-9)), 0, most_classes - 1);
}

struct Sizes {
  Vector3 lower = Vector3::Constant(std::numeric_limits<Real>::infinity());
  Real largest = 0;
  std::array<Real, most_classes> radius{};  ///< largest of each class; 0 where it is empty

  explicit Sizes(const state::Spheres& spheres) {
    for (const auto& place : spheres.place) {
      lower = lower.cwiseMin(place.centre());
      largest = std::max(largest, place.radius);
    }
    for (const auto& place : spheres.place) {
      Real& most = radius[static_cast<std::size_t>(class_of(place.radius, largest))];
      most = std::max(most, place.radius);
    }
  }

  Real smallest() const {
    for (std::size_t c = most_classes; c-- > 0;)
      if (radius[c] > 0) return radius[c];
    return 1;
  }
};

/// Looks for pairs in the size classes of a body.
class Search {
public:
  Search(const state::Spheres& spheres, Real margin)
      : spheres_(spheres), margin_(margin), length_(spheres.box.length), inverse_(spheres.box.inverse()) {
    const Sizes sizes(spheres);
    std::array<std::vector<Index>, most_classes> members;
    class_.resize(spheres.size());
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      class_[i] = static_cast<std::uint8_t>(class_of(spheres.place[i].radius, sizes.largest));
      members[class_[i]].push_back(static_cast<Index>(i));
    }
    for (std::size_t c = 0; c < most_classes; ++c) {
      number_[c] = cells_.size();
      if (members[c].empty()) continue;
      cells_.emplace_back(Grid(spheres.box, sizes.lower, 2 * sizes.radius[c] + margin));
      cells_.back().fill(spheres, members[c]);
      members[c] = {};
    }
  }

  SpherePairs run() {
    const std::size_t blocks = (spheres_.size() + block_size - 1) / block_size;
    std::vector<Block> found(blocks);
    parallel::parallel_for(blocks, 2, [&](std::size_t begin, std::size_t end) {
      for (std::size_t block = begin; block < end; ++block) look(block, found[block]);
    });
    std::vector<std::pair<Index, Index>> mixed;  // pairs of two classes, by first sphere
    for (Block& block : found) {
      mixed.insert(mixed.end(), block.mixed.begin(), block.mixed.end());
      block.mixed = {};
    }
    std::ranges::sort(mixed);
    cells_.clear();
    return join(std::move(found), mixed);
  }

private:
  struct Block {
    std::vector<std::uint32_t> counts;
    std::vector<Index> other;
    std::vector<std::pair<Index, Index>> mixed;
  };

  bool is_near(const state::SpherePlace& a, const state::SpherePlace& b) const {
    Real dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
    dx -= length_.x() * std::nearbyint(dx * inverse_.x());
    dy -= length_.y() * std::nearbyint(dy * inverse_.y());
    dz -= length_.z() * std::nearbyint(dz * inverse_.z());
    const Real reach = a.radius + b.radius + margin_;
    return dx * dx + dy * dy + dz * dz < reach * reach;
  }

  /// Calls f(j) for the spheres of a class in the cells around a place.
  template <class F>
  static void visit(const Cells& cells, const std::vector<Cells::Range>& ranges, F&& f) {
    for (const auto& range : ranges)
      for (std::uint32_t n = range.begin; n < range.end; ++n) f(cells.items[n]);
  }

  struct Around {
    Place place{-1, -1, -1};
    std::vector<Cells::Range> ranges;

    void move_to(const Cells& cells, const Vector3& centre) {
      const Place now = cells.grid.place_of(centre);
      if (now == place) return;
      place = now;
      ranges.clear();
      for (const std::uint64_t key : cells.grid.around(place))
        if (const auto range = cells.at(key); range.end > 0) ranges.push_back(range);
    }
  };

  void look(std::size_t number, Block& block) const {
    std::vector<Around> around(cells_.size());
    const std::size_t end = std::min((number + 1) * block_size, spheres_.size());
    for (std::size_t i = number * block_size; i < end; ++i) {
      const auto& own = spheres_.place[i];
      const std::size_t before = block.other.size();
      const std::size_t own_class = number_[class_[i]];
      for (std::size_t c = 0; c <= own_class; ++c) {
        around[c].move_to(cells_[c], own.centre());
        visit(cells_[c], around[c].ranges, [&](Index j) {
          const auto other = static_cast<std::size_t>(j);
          if (c == own_class) {
            if (other > i && is_near(own, spheres_.place[other])) block.other.push_back(j);
          } else if (is_near(own, spheres_.place[other])) {
            block.mixed.emplace_back(std::min(static_cast<Index>(i), j), std::max(static_cast<Index>(i), j));
          }
        });
      }
      block.counts.push_back(static_cast<std::uint32_t>(block.other.size() - before));
    }
  }

  /// One list of what the blocks have found, which is given up on the way.
  SpherePairs join(std::vector<Block> found, const std::vector<std::pair<Index, Index>>& mixed) const {
    SpherePairs pairs;
    pairs.first.reserve(spheres_.size() + 1);
    pairs.first.push_back(0);
    std::size_t total = mixed.size();
    for (const Block& block : found) total += block.other.size();
    pairs.other.reserve(total);
    auto next = mixed.begin();
    for (Block& block : found) {
      auto from = block.other.begin();
      for (const std::uint32_t count : block.counts) {
        const auto i = static_cast<Index>(pairs.first.size() - 1);
        pairs.other.insert(pairs.other.end(), from, from + count);
        from += count;
        for (; next != mixed.end() && next->first == i; ++next) pairs.other.push_back(next->second);
        pairs.first.push_back(static_cast<std::uint32_t>(pairs.other.size()));
      }
      block = {};
    }
    return pairs;
  }

  const state::Spheres& spheres_;
  Real margin_;
  Vector3 length_, inverse_;
  std::vector<std::uint8_t> class_;
  std::array<std::size_t, most_classes> number_{};  ///< of a class in `cells_`
  std::vector<Cells> cells_;                        ///< of the classes that are not empty, largest spheres first
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

std::vector<Index> order_along_curve(const state::Spheres& spheres, Real margin) {
  const Sizes sizes(spheres);
  const Grid grid(spheres.box, sizes.lower, 2 * sizes.smallest() + margin);
  std::vector<std::pair<std::uint64_t, Index>> keyed(spheres.size());
  parallel::parallel_for(spheres.size(), 20000, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      keyed[i] = {Grid::key(grid.place_of(spheres.place[i].centre())), static_cast<Index>(i)};
  });
  std::ranges::sort(keyed);
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
  permute(spheres.place, order);
  permute(spheres.spin, order);
  permute(spheres.kick, order);
  if (!spheres.turn.empty()) permute(spheres.turn, order);
  permute(spheres.number, order);
}

SpherePairs find_pairs(const state::Spheres& spheres, Real margin) { return Search(spheres, margin).run(); }

}  // namespace sazare::neighbors
