#include "sazare/geometry/plane/voronoi.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sazare/core/morton.hpp"
#include "sazare/core/random.hpp"
#include "sazare/core/saturated.hpp"

namespace sazare::geometry {

namespace {

constexpr Real least_distance = 0.6;  // of a spacing, between random places: leaves room for all of them
constexpr int most_tries = 10000;     // for a place
constexpr int lloyd_steps = 4;
constexpr Real shortest_side = 1e-6;  // of a cell

struct Box {
  Vector2 lower, upper;

  explicit Box(std::span<const Vector2> points) : lower(points.front()), upper(points.front()) {
    for (const Vector2& point : points) {
      lower = lower.cwiseMin(point);
      upper = upper.cwiseMax(point);
    }
  }
};

/// Points by the squares of a grid that they stand in.
class Buckets {
public:
  Buckets(const Box& box, Real width) : lower_(box.lower), width_(width) {
    for (int axis = 0; axis < 2; ++axis)
      size_[axis] = saturated<std::int32_t>((box.upper[axis] - box.lower[axis]) / width) + std::int64_t{1};
    buckets_.resize(static_cast<std::size_t>(size_[0] * size_[1]));
  }

  void add(Index number, const Vector2& point) {
    const auto [x, y] = place(point);
    buckets_[static_cast<std::size_t>(y * size_[0] + x)].push_back(number);
  }

  /// Calls visit(number) for points in the squares that stand `ring` squares away; false where there is no such square.
  template <class Visit>
  bool visit_ring(const Vector2& around, std::int64_t ring, Visit&& visit) const {
    const auto [x, y] = place(around);
    bool any = false;
    const auto visit_square = [&](std::int64_t i, std::int64_t j) {
      any = true;
      for (const Index number : buckets_[static_cast<std::size_t>(j * size_[0] + i)]) visit(number);
    };
    const std::int64_t left = x - ring, right = x + ring, last = std::min(size_[1] - 1, y + ring);
    const bool has_left = left >= 0, has_right = right < size_[0];
    for (std::int64_t j = std::max<std::int64_t>(0, y - ring); j <= last; ++j) {
      if (j == y - ring || j == y + ring) {
        for (std::int64_t i = std::max<std::int64_t>(0, left); i <= std::min(size_[0] - 1, right); ++i) visit_square(i, j);
        continue;
      }
      if (!has_left && !has_right) {  // a grid may be narrow and very long
        j = y + ring - 1;
        continue;
      }
      if (has_left) visit_square(left, j);
      if (has_right) visit_square(right, j);
    }
    return any;
  }

  /// No point of a ring is nearer than this [m].
  Real distance_of(std::int64_t ring) const { return static_cast<Real>(std::max<std::int64_t>(ring - 1, 0)) * width_; }

private:
  std::pair<std::int64_t, std::int64_t> place(const Vector2& point) const {
    const auto at = [&](int axis) {
      const auto square = saturated<std::int64_t>((point[axis] - lower_[axis]) / width_);
      return std::clamp<std::int64_t>(square, 0, size_[axis] - 1);
    };
    return {at(0), at(1)};
  }

  Vector2 lower_;
  Real width_ = 0;
  std::array<std::int64_t, 2> size_{};
  std::vector<std::vector<Index>> buckets_;
};

/// Leaves of a cell what lies on the near side of the middle line to another nucleus.
void cut(VoronoiCell& cell, const Vector2& nucleus, Index other_number, const Vector2& other) {
  const Vector2 middle = 0.5 * (nucleus + other), direction = other - nucleus;
  const std::size_t n = cell.corners.size();
  const auto height = [&](std::size_t corner) { return direction.dot(cell.corners[corner] - middle); };
  bool all_inside = true;
  for (std::size_t i = 0; i < n && all_inside; ++i) all_inside = height(i) <= 0;
  if (all_inside) return;
  VoronoiCell left;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const Real here = height(i), there = height(next);
    if (here <= 0) {
      left.corners.push_back(cell.corners[i]);
      left.beyond.push_back(cell.beyond[i]);
    }
    if ((here <= 0) == (there <= 0)) continue;
    left.corners.push_back(cell.corners[i] + here / (here - there) * (cell.corners[next] - cell.corners[i]));
    left.beyond.push_back(here <= 0 ? other_number : cell.beyond[i]);
  }
  cell = std::move(left);
}

void leave_out_short_sides(VoronoiCell& cell) {
  const Real shortest = shortest_side * std::sqrt(measure(cell.corners).area);
  VoronoiCell kept;
  const std::size_t n = cell.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    if ((cell.corners[(i + 1) % n] - cell.corners[i]).norm() < shortest) continue;
    kept.corners.push_back(cell.corners[i]);
    kept.beyond.push_back(cell.beyond[i]);
  }
  cell = std::move(kept);
}

VoronoiCell cell_of(std::span<const Vector2> nuclei, Index own, const Buckets& buckets, std::span<const Vector2> outline) {
  const Vector2 nucleus = nuclei[static_cast<std::size_t>(own)];
  VoronoiCell cell{{outline.begin(), outline.end()}, std::vector<Index>(outline.size(), VoronoiCell::outside)};
  const auto reach = [&] {
    Real square = 0;
    for (const Vector2& corner : cell.corners) square = std::max(square, (corner - nucleus).squaredNorm());
    return 2 * std::sqrt(square);
  };
  for (std::int64_t ring = 0; buckets.distance_of(ring) <= reach(); ++ring) {
    const bool any = buckets.visit_ring(nucleus, ring, [&](Index other) {
      if (other != own) cut(cell, nucleus, other, nuclei[static_cast<std::size_t>(other)]);
    });
    if (!any) break;
  }
  leave_out_short_sides(cell);
  return cell;
}

}  // namespace

std::vector<VoronoiCell> voronoi_cells(std::span<const Vector2> nuclei, std::span<const Vector2> outline) {
  Buckets buckets(Box(outline), std::sqrt(measure(outline).area / static_cast<Real>(nuclei.size())));
  for (std::size_t i = 0; i < nuclei.size(); ++i) buckets.add(static_cast<Index>(i), nuclei[i]);
  std::vector<VoronoiCell> cells(nuclei.size());
  for (std::size_t i = 0; i < nuclei.size(); ++i) cells[i] = cell_of(nuclei, static_cast<Index>(i), buckets, outline);
  return cells;
}

std::vector<Vector2> scatter_nuclei(std::span<const Vector2> outline, Real spacing, int seed) {
  const Box box(outline);
  const auto count = saturated<std::size_t>(std::max(1.0, std::round(measure(outline).area / (spacing * spacing))));
  Random random(seed);
  Buckets buckets(box, spacing);
  std::vector<Vector2> nuclei;
  Real distance = least_distance * spacing;
  for (int tries = 0; nuclei.size() < count; ++tries) {
    if (tries > most_tries) {  // in a corner so narrow that chance has left no room
      distance *= 0.9;
      tries = 0;
    }
    const Real x = random.between(box.lower.x(), box.upper.x()), y = random.between(box.lower.y(), box.upper.y());
    const Vector2 place(x, y);
    bool has_room = holds(outline, place);
    for (std::int64_t ring = 0; ring < 2; ++ring)
      buckets.visit_ring(place, ring, [&](Index other) {
        has_room = has_room && (nuclei[static_cast<std::size_t>(other)] - place).norm() >= distance;
      });
    if (!has_room) continue;
    buckets.add(static_cast<Index>(nuclei.size()), place);
    nuclei.push_back(place);
    tries = 0;
  }
  sort_along_curve(nuclei, spacing);
  for (int step = 0; step < lloyd_steps; ++step) {
    const auto cells = voronoi_cells(nuclei, outline);
    for (std::size_t i = 0; i < nuclei.size(); ++i) nuclei[i] = measure(cells[i].corners).centroid;
  }
  return nuclei;
}

void sort_along_curve(std::vector<Vector2>& places, Real spacing) {
  if (places.empty()) return;
  const Vector2 lower = Box(places).lower;
  const auto on_curve = [&](const Vector2& place) {
    const Vector2 square = (place - lower) / spacing;
    return spread_for_two(static_cast<std::uint64_t>(square.x())) | spread_for_two(static_cast<std::uint64_t>(square.y())) << 1;
  };
  std::ranges::stable_sort(places, {}, on_curve);
}

}  // namespace sazare::geometry
