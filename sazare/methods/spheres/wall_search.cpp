/// Which spheres are near walls, found anew in time, and whether one went through a surface meanwhile.

#include <algorithm>
#include <numeric>

#include "sazare/methods/spheres/wall_contacts.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::methods::spheres {

namespace {

Vector3 middle_of(const geometry::Triangle& corners) { return (corners[0] + corners[1] + corners[2]) / 3; }

/// Adds to places the same ones beyond those sides of a domain that are within a margin of them.
void add_beyond(const state::PeriodicBox& box, Real margin, std::vector<Vector3>& places) {
  for (int axis = 0; axis < 3; ++axis) {
    if (box.length[axis] <= 0) continue;
    const Vector3 length = box.length[axis] * Vector3::Unit(axis);
    for (std::size_t n = 0, count = places.size(); n < count; ++n) {
      const Vector3 place = places[n];
      const Real at = place[axis] - box.lower[axis];
      if (at < margin) places.push_back(place + length);
      if (box.length[axis] - at < margin) places.push_back(place - length);
    }
  }
}

}  // namespace

/// A place of the domain as a wall at the start would have it; a wall with periodic images has it within its first image.
Vector3 WallContacts::seen_by(std::size_t wall, const Vector3& place) const {
  const Vector3 at = poses_[wall].into(place);
  const state::PeriodicBox& images = walls_[wall].images;
  return images.repeats() ? images.wrapped(at) : at;
}

/// All places where a surface may see a sphere until it is sought again: beyond a periodic side, too, where it may cross that.
void WallContacts::places_seen_by(std::size_t wall, const state::SpherePlace& place, const state::PeriodicBox& box, Real margin,
                                  std::vector<Vector3>& places) const {
  places.assign(1, box.wrapped(place.centre()));
  add_beyond(box, margin, places);
  for (Vector3& one : places) one = seen_by(wall, one);
  add_beyond(walls_[wall].images, margin, places);
}

/// Adds the triangles of a surface that are near a sphere, in the order of the file.
void WallContacts::find_surface(std::size_t wall, const state::Spheres& spheres, std::size_t sphere, Real margin,
                                std::vector<Near>& near) const {
  thread_local std::vector<Vector3> places;
  const state::SpherePlace& place = spheres.place[sphere];
  const auto begin = static_cast<std::ptrdiff_t>(near.size());
  places_seen_by(wall, place, spheres.box, margin, places);
  for (const Vector3& centre : places)
    for (const std::int32_t t : trees_[wall].near(centre)) {
      const geometry::Triangle corners = triangle(wall, t);
      if ((geometry::nearest_point(corners, centre) - centre).norm() < place.radius + margin)
        near.push_back({static_cast<Index>(sphere), static_cast<Index>(wall), t, places.front() - middle_of(corners)});
    }
  if (places.size() == 1) return;
  std::ranges::stable_sort(near.begin() + begin, near.end(), {}, &Near::triangle);
  const auto twice = std::ranges::unique(near.begin() + begin, near.end(), {}, &Near::triangle);
  near.erase(twice.begin(), twice.end());
}

/// Touches of a tile: those of surfaces by sphere, then those of each plane by sphere.
WallContacts::Kept WallContacts::kept_by(const Tile& tile) const {
  Kept all{tile.touches, tile.bands};
  for (std::size_t w = 0; w < tile.planes.size(); ++w)
    for (std::size_t n = 0; n < tile.planes[w].size(); ++n) {
      if (!tile.planes[w].remembers(n)) continue;
      const laws::ContactMemory<Real> memory = tile.planes[w].memory(n);
      all.touches.push_back({.sphere = tile.planes[w][n],
                             .wall = static_cast<Index>(w),
                             .sliding = memory.sliding,
                             .rolling = memory.rolling,
                             .twisting = memory.twisting});
      if (table_.slips_in_part()) all.bands.push_back(tile.planes[w].bands(n));
    }
  return all;
}

/// Touches of all parts and tiles, one after the other.
WallContacts::Kept WallContacts::kept() const {
  Kept all;
  for (const auto& tiles : parts_)
    for (const Tile& tile : tiles) all.add(kept_by(tile));
  return all;
}

void WallContacts::find(const state::Spheres& spheres, Real time, Real margin, std::span<const Index> new_place,
                        const Parts& parts) {
  move(time);
  if (surface() != nullptr) {
    std::vector<geometry::Triangle> now;
    for (std::size_t face = 0; face < surface()->face_count(); ++face) now.push_back(surface()->corners(face, time));
    trees_[surface_] = geometry::TriangleTree(now, reach_);
  }
  Kept before = kept();
  if (!new_place.empty()) {
    for (Touch& touch : before.touches) touch.sphere = new_place[static_cast<std::size_t>(touch.sphere)];
    if (parts.ranks != nullptr) before = hand_on(before, *parts.ranks);
  }
  std::vector<std::size_t> order(before.touches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!new_place.empty()) std::ranges::stable_sort(order, {}, [&](std::size_t n) { return before.touches[n].sphere; });
  const std::size_t tile_count = neighbors::tiles_of(spheres.size());
  Tile empty;
  empty.planes.resize(walls_.size());
  empty.loads.resize(walls_.size());
  parts_.assign(parts.count, std::vector<Tile>(tile_count, empty));
  const auto tile_of = [&](std::size_t sphere) -> Tile& {
    const std::size_t part = parts.of.empty() ? 0 : static_cast<std::size_t>(parts.of[sphere]);
    return parts_[part][sphere / neighbors::tile_size];
  };
  parallel::parallel_for(tile_count, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * neighbors::tile_size; i < std::min(end * neighbors::tile_size, spheres.size()); ++i)
      if (parts.owns(i / neighbors::tile_size)) find_near(spheres, i, margin, tile_of(i));
  });
  for (const std::size_t n : order) {
    const Touch& touch = before.touches[n];
    if (!parts.owns(static_cast<std::size_t>(touch.sphere) / neighbors::tile_size)) continue;  // of a checkpoint, which has all
    remember(touch, before.bands.empty() ? nullptr : &before.bands[n], tile_of(static_cast<std::size_t>(touch.sphere)));
  }
}

/// Gives each touch to the rank that works for its sphere from now on. Those of one sphere come from one rank, in their order.
WallContacts::Kept WallContacts::hand_on(const Kept& before, RankTiles& ranks) {
  std::vector<Kept> to_each(static_cast<std::size_t>(ranks.ranks().size()));
  for (std::size_t n = 0; n < before.touches.size(); ++n) {
    Kept& to = to_each[static_cast<std::size_t>(ranks.owners().owner_of_sphere(before.touches[n].sphere))];
    to.touches.push_back(before.touches[n]);
    if (!before.bands.empty()) to.bands.push_back(before.bands[n]);
  }
  Kept own;
  for (const Kept& arrived : ranks.hand_on(std::move(to_each))) own.add(arrived);
  return own;
}

/// Adds a sphere to the rows of the planes, and to the triangles, that are near it.
void WallContacts::find_near(const state::Spheres& spheres, std::size_t sphere, Real margin, Tile& tile) const {
  const state::SpherePlace& place = spheres.place[sphere];
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const Wall& wall = walls_[w];
    if (wall.is_surface()) {
      find_surface(w, spheres, sphere, margin, tile.near);
      continue;
    }
    if (surface_of_[w] == lies_in_another) continue;
    const Vector3 centre = seen_by(w, spheres.box.wrapped(place.centre()));
    if ((centre - wall.point).dot(wall.normal) < place.radius + margin)
      tile.planes[w].add(static_cast<Index>(sphere), table_.remembered(), table_.adheres());
  }
}

/// Hands a touch back to the tile of its sphere, where near spheres are known.
void WallContacts::remember(const Touch& touch, const Bands* bands, Tile& tile) const {
  const auto w = static_cast<std::size_t>(touch.wall);
  if (walls_[w].is_plane())
    return tile.planes[w].remember(touch.sphere, {touch.sliding, touch.rolling, touch.twisting},
                                   bands == nullptr ? Bands{} : *bands);
  tile.touches.push_back(touch);
  if (bands != nullptr) tile.bands.push_back(*bands);
}

void WallContacts::look_back(const state::Spheres& spheres, Real time) {
  if (!have_surfaces()) return;
  move(time);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    parallel::parallel_for(parts_[part].size(), 2, [&](std::size_t begin, std::size_t end) {
      for (Tile& tile : std::span(parts_[part]).subspan(begin, end - begin))
        for (Near& one : tile.near) {
          const auto w = static_cast<std::size_t>(one.wall);
          const auto sphere = static_cast<std::size_t>(one.sphere);
          const Vector3 centre = spheres.box.wrapped(spheres.place[sphere].centre());
          if (went_through(one, triangle(w, one.triangle), seen_by(w, centre), 0, spheres.box) && !tile.passage)
            tile.passage = {spheres.number[sphere], one.wall, centre, time_};
        }
    });
    note_passages(part);
  }
}

/// Whether a centre went through a triangle since it was last seen, as seen from the triangle's middle; now it is seen here, at
/// this distance or more.
bool WallContacts::went_through(Near& one, const geometry::Triangle& corners, const Vector3& centre, Real distance,
                                const state::PeriodicBox& box) const {
  const Vector3 at = centre - middle_of(corners);
  Vector3 way = at - one.before;
  one.before = at;
  if (way.squaredNorm() < distance * distance) return false;
  if (box.repeats()) {
    const Matrix3& turn = poses_[static_cast<std::size_t>(one.wall)].turn;
    way = turn.transpose() * box.nearest(turn * way);  // from the other side of the domain
  }
  return geometry::leads_through(corners, centre - way, centre);
}

void WallContacts::note_passages(std::size_t part) {
  if (part >= parts_.size()) return;
  for (std::size_t tile = 0; tile < parts_[part].size(); ++tile)
    if (const auto& passage = parts_[part][tile].passage; passage && !passage_)
      agree_on(*passage, static_cast<std::int64_t>(tile));
}

bool WallContacts::have_surfaces() const { return std::ranges::any_of(walls_, &Wall::is_surface); }

}  // namespace sazare::methods::spheres
