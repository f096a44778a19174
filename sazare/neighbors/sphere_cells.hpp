#pragma once

/// Spheres by size and by cell of a grid.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "sazare/core/exact_sum.hpp"
#include "sazare/neighbors/cell_order.hpp"
#include "sazare/neighbors/sphere_pairs.hpp"
#include "sazare/parallel/sort.hpp"
#include "sazare/parallel/sum_over_ranges.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::neighbors {

/// Where some spheres are, and how large.
struct SphereExtent {
  Vector3 lower = Vector3::Constant(std::numeric_limits<Real>::infinity()), upper = -lower;
  Real largest = 0;
  std::int64_t count = 0;
  ExactSum radii;

  void add(const state::Spheres& spheres, std::size_t begin, std::size_t end) {
    count += static_cast<std::int64_t>(end - begin);
    const Vector3 inverse = spheres.box.inverse();
    for (const auto& place : std::span(spheres.place).subspan(begin, end - begin)) {
      const Vector3 at = spheres.box.wrapped(place.centre(), inverse);
      lower = lower.cwiseMin(at);
      upper = upper.cwiseMax(at);
      largest = std::max(largest, place.radius);
      radii += place.radius;
    }
  }

  SphereExtent& operator+=(const SphereExtent& more) {
    lower = lower.cwiseMin(more.lower);
    upper = upper.cwiseMax(more.upper);
    largest = std::max(largest, more.largest);
    count += more.count;
    radii += more.radii;
    return *this;
  }
};

/// Where spheres are, and how large.
struct SphereSizes {
  static constexpr std::size_t serial_below = 20000;
  static constexpr int most_classes = 16;

  Vector3 lower = Vector3::Constant(std::numeric_limits<Real>::infinity()), upper = -lower;
  Real largest = 0;
  Real mean = 0;
  std::array<Real, most_classes> radius{};  ///< largest of each class; 0 where it is empty

  explicit SphereSizes(const state::Spheres& spheres) : SphereSizes(extent_of(spheres)) {
    for (const auto& place : spheres.place) take(place.radius);
  }
  /// Those with such an extent; their radii are to be taken.
  explicit SphereSizes(const SphereExtent& all)
      : lower(all.lower),
        upper(all.upper),
        largest(all.largest),
        mean(all.radii.value() / static_cast<Real>(std::max<std::int64_t>(all.count, 1))) {}

  static SphereExtent extent_of(const state::Spheres& spheres) {
    SphereExtent all;
    parallel::sum_over_ranges(spheres.size(), serial_below, all,
                              [&](std::size_t begin, std::size_t end, SphereExtent& part) { part.add(spheres, begin, end); });
    return all;
  }

  /// The largest radius of its class grows by it.
  void take(Real of_sphere) {
    if (!(of_sphere > 0)) return;  // an empty class of others
    Real& most = radius[class_of(of_sphere)];
    most = std::max(most, of_sphere);
  }

  /// Which class: 0 for the largest spheres, each further one for half the radius.
  std::size_t class_of(Real of_sphere) const {
    constexpr Real round_off = 1 + 1e-9;
    return static_cast<std::size_t>(std::clamp(std::ilogb(round_off * largest / of_sphere), 0, most_classes - 1));
  }

  Real smallest() const {
    for (std::size_t c = most_classes; c-- > 0;)
      if (radius[c] > 0) return radius[c];
    return 1;
  }

  /// As wide as a tile of spheres in a bed.
  Real tile_width() const {
    constexpr Real ball = 4.0 / 3.0 * std::numbers::pi, solid_share = 0.6;
    return mean * std::cbrt(static_cast<Real>(tile_size) * ball / solid_share);
  }
};

/// Cells of one width over all that has spheres; along periodic axes over the whole box.
class CellGrid {
public:
  CellGrid(const state::PeriodicBox& box, const SphereSizes& sizes, Real least_width)
      : box_(box),
        inverse_(box.inverse()),
        lower_(sizes.lower),
        width_(Vector3::Constant(least_width)),
        order_(cut(sizes)),
        per_width_(width_.cwiseInverse()) {}

  CellPlace place_of(const Vector3& centre) const {
    const Vector3 at = box_.wrapped(centre, inverse_);
    CellPlace place;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      // Far away spheres share the last cell: slow, and right. Those at no place are in the first: the greater of 0 and nan is 0.
      const Real cell = std::max(Real{0}, (at[axis] - lower_[axis]) * per_width_[axis]);
      place[a] = static_cast<std::int64_t>(std::min(cell, static_cast<Real>(count_[a] - 1)));
    }
    return place;
  }

  std::uint64_t key(const CellPlace& place) const { return order_.key(place); }

  /// Calls f(key) for the cell and its neighbours, each once.
  template <class F>
  void around(const CellPlace& place, F&& f) const {
    const std::array along{parts_around(0, place[0]), parts_around(1, place[1]), parts_around(2, place[2])};
    for (std::size_t z = 0; z < along[2].count; ++z)
      for (std::size_t y = 0; y < along[1].count; ++y)
        for (std::size_t x = 0; x < along[0].count; ++x) f(along[0].parts[x] | along[1].parts[y] | along[2].parts[z]);
  }

private:
  /// Parts of the keys of a cell and those beside it on an axis.
  struct Parts {
    std::array<std::uint64_t, 3> parts;
    std::size_t count = 0;
  };

  Parts parts_around(std::size_t axis, std::int64_t at) const {
    Parts around;
    const std::int64_t count = count_[axis];
    const auto add = [&](std::int64_t cell) { around.parts[around.count++] = order_.part(axis, cell); };
    const bool goes_round = repeats(axis) && count > 2;  // of two cells each has the other one once, not on both sides
    if (at > 0 || goes_round) add((at + count - 1) % count);
    add(at);
    if (at + 1 < count || goes_round) add((at + 1) % count);
    return around;
  }

  bool repeats(std::size_t axis) const { return box_.length[static_cast<int>(axis)] > 0; }

  /// Sets the cells on each axis.
  CellOrder cut(const SphereSizes& sizes) {
    constexpr Real most = CellOrder::most_cells - 1;
    std::array<Real, 3> cube;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<int>(a);
      const Real length = repeats(a) ? box_.length[axis] : sizes.upper[axis] - sizes.lower[axis];
      const Real whole = length / width_[axis];
      count_[a] = whole < most ? static_cast<std::int64_t>(std::max(whole, Real{0})) : CellOrder::most_cells - 1;
      count_[a] = repeats(a) ? std::max<std::int64_t>(1, count_[a]) : count_[a] + 1;
      if (repeats(a)) {
        width_[axis] = length / static_cast<Real>(count_[a]);
        lower_[axis] = box_.lower[axis];
      }
      cube[a] = sizes.tile_width() / width_[axis];
    }
    return {count_, cube, longest()};
  }

  /// The axis of the greatest length, the last one of equal ones. A periodic box is cut at two ends, so its lengths count for
  /// half.
  std::size_t longest() const {
    std::size_t longest = 2;
    const auto length = [&](std::size_t a) {
      return width_[static_cast<int>(a)] * static_cast<Real>(count_[a]) / (repeats(a) ? 2 : 1);
    };
    for (const std::size_t a : {std::size_t{1}, std::size_t{0}})
      if (length(a) > length(longest)) longest = a;
    return longest;
  }

  state::PeriodicBox box_;
  Vector3 inverse_, lower_, width_;
  CellPlace count_{};
  CellOrder order_;
  Vector3 per_width_;
};

/// Some spheres by cell.
class SphereCells {
public:
  /// The items of a cell: items[begin] .. items[end - 1].
  struct Range {
    std::uint32_t begin = 0, end = 0;
  };

  SphereCells(const CellGrid& of, const state::Spheres& spheres, std::span<const Index> members) : grid(of) {
    std::vector<std::pair<std::uint64_t, Index>> keyed(members.size());
    parallel::parallel_for(members.size(), 20000, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n)
        keyed[n] = {grid.key(grid.place_of(spheres.place[static_cast<std::size_t>(members[n])].centre())), members[n]};
    });
    stands_in_order = std::ranges::is_sorted(keyed);
    if (!stands_in_order) parallel::sort(keyed);
    items.resize(keyed.size());
    std::size_t cells = 1, size = 16;
    for (std::size_t n = 1; n < keyed.size(); ++n) cells += keyed[n].first != keyed[n - 1].first ? 1 : 0;
    while (2 * size < 3 * cells) size *= 2;
    table_.assign(size, {});
    for (std::uint32_t begin = 0; begin < keyed.size();) {
      std::uint32_t end = begin;
      for (; end < keyed.size() && keyed[end].first == keyed[begin].first; ++end) items[end] = keyed[end].second;
      table_[find(keyed[begin].first)] = {keyed[begin].first, {begin, end}};
      begin = end;
    }
  }

  Range at(std::uint64_t key) const { return table_[find(key)].range; }

  CellGrid grid;
  std::vector<Index> items;
  bool stands_in_order =
      false;  ///< spheres stand in memory as their cells do: no sphere of an earlier cell is behind one of a later

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

}  // namespace sazare::neighbors
