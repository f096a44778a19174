#include "sazare/methods/spheres/ranks/near_tiles.hpp"

#include <algorithm>
#include <limits>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

/// Boxes go around so many spheres that stand one after the other, or around more where ranks are many: all ranks together tell
/// of so many boxes at most.
constexpr std::size_t granule = 64, most_boxes = 65536;
static_assert(neighbors::tile_size % granule == 0);
/// Boxes are taken to be wider by this share of a reach and of a place, so that round-off leaves out no sphere.
constexpr Real round_off = 1e-9;

/// Where some spheres are in the box of the domain, and the largest radius.
struct TileBox {
  std::array<Real, 3> lower = {infinity, infinity, infinity}, upper = {-infinity, -infinity, -infinity};
  Real radius = 0;

  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  void take(const Vector3& at, Real of_sphere) {
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = std::min(lower[a], at[static_cast<int>(a)]);
      upper[a] = std::max(upper[a], at[static_cast<int>(a)]);
    }
    radius = std::max(radius, of_sphere);
  }
  void take(const TileBox& more) {
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = std::min(lower[a], more.lower[a]);
      upper[a] = std::max(upper[a], more.upper[a]);
    }
    radius = std::max(radius, more.radius);
  }
};

/// Whether boxes are nearer to each other than the radii of their spheres and a margin; by the nearest image in a periodic domain.
class Nearness {
public:
  Nearness(const state::PeriodicBox& box, Real margin) : box_(box), inverse_(box.inverse()), margin_(margin) {}

  Vector3 within(const state::SpherePlace& place) const { return box_.wrapped(place.centre(), inverse_); }

  bool operator()(const TileBox& one, const TileBox& other) const {
    Real square = 0, far = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const Real gap = gap_on(a, one, other);
      square += gap * gap;
      far = std::max({far, std::abs(one.lower[a]), std::abs(one.upper[a])});
    }
    const Real reach = (1 + round_off) * (one.radius + other.radius + margin_) + round_off * far;
    return square < reach * reach;
  }

private:
  Real gap_on(std::size_t axis, const TileBox& one, const TileBox& other) const {
    const auto gap = [&](Real shift) {
      return std::max({Real{0}, other.lower[axis] + shift - one.upper[axis], one.lower[axis] - (other.upper[axis] + shift)});
    };
    const Real length = box_.length[static_cast<int>(axis)];
    return length > 0 ? std::min({gap(0), gap(length), gap(-length)}) : gap(0);
  }

  state::PeriodicBox box_;
  Vector3 inverse_;
  Real margin_;
};

/// Around the spheres of each granule of own tiles.
std::vector<TileBox> boxes_of_own(const RankTiles& ranks, const state::Spheres& spheres, const Nearness& nearness) {
  constexpr std::size_t of_tile = neighbors::tile_size / granule;
  const std::vector<std::size_t>& own = ranks.owners().own();
  std::vector<TileBox> boxes(own.size() * of_tile);
  parallel::parallel_for(own.size(), 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      ranks.visit_tile(own[n], [&](std::size_t i) {
        const std::size_t in_tile = i % neighbors::tile_size / granule;
        boxes[n * of_tile + in_tile].take(nearness.within(spheres.place[i]), spheres.place[i].radius);
      });
  });
  return boxes;
}

/// So many boxes at most, each around as many of these but one.
std::vector<TileBox> gathered(const std::vector<TileBox>& boxes, std::size_t most) {
  const std::vector<std::size_t> cuts = even_cuts(boxes.size(), most);
  std::vector<TileBox> some(boxes.empty() ? 0 : cuts.size() - 1);
  for (std::size_t n = 0; n < some.size(); ++n)
    for (std::size_t box = cuts[n]; box < cuts[n + 1]; ++box) some[n].take(boxes[box]);
  return some;
}

/// Those of a list that are near a box.
void find_beside(const Nearness& is_near, const TileBox& box, const std::vector<TileBox>& others, std::vector<TileBox>& beside) {
  beside.clear();
  std::ranges::copy_if(others, std::back_inserter(beside), [&](const TileBox& other) { return is_near(box, other); });
}

/// The places of own spheres near boxes of another rank. `granules` go around own ones.
std::vector<Index> spheres_near(const RankTiles& ranks, const state::Spheres& spheres, const Nearness& is_near,
                                const std::vector<TileBox>& granules, const std::vector<TileBox>& boxes) {
  constexpr std::size_t of_tile = neighbors::tile_size / granule;
  const std::vector<std::size_t>& own = ranks.owners().own();
  std::vector<Index> near;
  std::vector<TileBox> beside_tile, beside;
  for (std::size_t n = 0; n < own.size(); ++n) {
    TileBox tile;
    for (std::size_t g = 0; g < of_tile; ++g) tile.take(granules[n * of_tile + g]);
    find_beside(is_near, tile, boxes, beside_tile);
    if (beside_tile.empty()) continue;
    ranks.visit_tile(own[n], [&](std::size_t i) {
      const std::size_t in_tile = i % neighbors::tile_size;
      if (in_tile % granule == 0) find_beside(is_near, granules[n * of_tile + in_tile / granule], beside_tile, beside);
      TileBox alone;
      alone.take(is_near.within(spheres.place[i]), spheres.place[i].radius);
      if (std::ranges::any_of(beside, [&](const TileBox& other) { return is_near(alone, other); }))
        near.push_back(static_cast<Index>(i));
    });
  }
  return near;
}

}  // namespace

std::vector<std::vector<Index>> spheres_near_others(const RankTiles& ranks, const state::Spheres& spheres, Real margin) {
  const Nearness is_near(spheres.box, margin);
  const std::vector<TileBox> granules = boxes_of_own(ranks, spheres, is_near);
  const auto count = static_cast<std::size_t>(ranks.ranks().size());
  const std::vector<std::vector<TileBox>> boxes =
      ranks.by_rank(gathered(granules, std::max<std::size_t>(most_boxes / count, 1)), parallel::Topic::search);
  std::vector<std::vector<Index>> near(count);
  parallel::parallel_for_uneven(count, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t rank = begin; rank < end; ++rank)
      if (static_cast<int>(rank) != ranks.ranks().rank())
        near[rank] = spheres_near(ranks, spheres, is_near, granules, boxes[rank]);
  });
  return near;
}

}  // namespace sazare::methods::spheres
