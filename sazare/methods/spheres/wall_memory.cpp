#include "sazare/methods/spheres/wall_contacts.hpp"

/// What spheres remember of a surface, from the points of one step to those of the next.

#include <algorithm>
#include <cmath>

namespace sazare::methods::spheres {

namespace {

constexpr Real same_direction = 0.9;  // cosine between the normals of one contact at two steps

/// A vector in the plane across a normal, turned with the normal to another one.
Vector3 turned(const Vector3& vector, const Vector3& from, const Vector3& to) {
  return from == to ? vector : Vector3(Eigen::Quaternion<Real>::FromTwoVectors(from, to) * vector);
}

/// From where to where a band reaches [m].
std::array<Real, 2> reach_of(const laws::SlipBands<Real>& all, std::size_t band) {
  if (band == 0) return {all.inner, all.width};
  const laws::bands::Extent& extent = laws::bands::extents[band];
  return {extent.inner * all.inner, (extent.inner + extent.width) * all.inner};
}

/// Adds the stretch of bands that lie elsewhere: each takes the mean of what lies within it, so that force is kept and energy is
/// not gained. What lies beyond the contact is lost.
void add(laws::SlipBands<Real>& all, const laws::SlipBands<Real>& more) {
  for (std::size_t band = 0; band < all.count; ++band) {
    const auto [inner, outer] = reach_of(all, band);
    if (!(outer - inner > laws::bands::negligible * all.width)) continue;
    for (std::size_t other = 0; other < more.count; ++other) {
      const auto [from, to] = reach_of(more, other);
      const Real common = std::min(outer, to) - std::max(inner, from);
      if (common > 0) all.stretch[band] += common / std::sqrt((outer - inner) * (to - from)) * more.stretch[other];
    }
  }
}

}  // namespace

/// The touch before that faces most nearly as a point does, of those that do not go on in another point.
const WallContacts::Touch* WallContacts::like(const Point& point, std::span<const Touch> before) const {
  const Touch* found = nullptr;
  Real most = same_direction;
  for (const Touch& one : before) {
    if (one.wall < 0 || !(one.share > 0) || surface_of(one.wall) != surface_of(point.wall)) continue;
    const Real along = one.normal.dot(point.normal);
    if (!(along > most)) continue;
    most = along;
    found = &one;
  }
  return found;
}

/// The points of a sphere from a number on go on from the touches `before`, or begin. Across a gap only a touch that was there
/// before remains.
void WallContacts::follow(std::size_t begin, std::span<Touch> before, std::vector<Point>& points, Followed& followed) const {
  followed.own.clear();
  followed.grown.clear();
  followed.lost.clear();
  for (const Touch& one : before) followed.lost.push_back(one.share);
  std::size_t kept = begin;
  for (std::size_t n = begin; n < points.size(); ++n) {
    Point& point = points[n];
    point.before = point.normal;
    const Touch* own = nullptr;
    if (point.share > 0) {
      own = like(point, before);
      if (own == nullptr && !(point.overlap > 0)) continue;
    }
    const Real had = own == nullptr ? 0 : own->share;
    if (own != nullptr) {
      const auto place = static_cast<std::size_t>(own - before.data());
      followed.lost[place] = std::max(had - point.share, Real{0});
      before[place].wall = ~own->wall;  // goes on
      point.before = own->normal;
    }
    followed.own.push_back(own);
    followed.grown.push_back(std::max(point.share - had, Real{0}));
    points[kept++] = point;
  }
  points.resize(kept);
}

/// How much of each touch before a point remembers. It keeps its own, and where its share grows it takes over from those that
/// face nearly as it does and whose shares fall: their mean, as far as they lose as much as these points gain. So the sum of
/// shares times stretches remains while a load passes from one facet to the next, and the energy, being a square, does not grow.
void WallContacts::find_parts(std::size_t n, std::span<const Point> points, std::span<const Touch> before,
                              const Followed& followed, std::vector<Part>& parts) const {
  parts.clear();
  const Point& point = points[n];
  const Touch* const own = followed.own[n];
  const Real grown = followed.grown[n];
  if (own != nullptr) parts.push_back({own, grown > 0 ? own->share / point.share : Real{1}});
  if (!(grown > 0)) return;
  const auto faces = [&](Index wall, const Vector3& normal) {
    return surface_of(wall < 0 ? ~wall : wall) == surface_of(point.wall) && normal.dot(point.normal) > same_direction;
  };
  Real lost = 0, all_grown = 0;
  for (std::size_t j = 0; j < before.size(); ++j)
    if (faces(before[j].wall, before[j].normal)) lost += followed.lost[j];
  for (std::size_t m = 0; m < points.size(); ++m)
    if (faces(points[m].wall, points[m].normal)) all_grown += followed.grown[m];
  const Real each = grown / (point.share * std::max(lost, all_grown));
  for (std::size_t j = 0; j < before.size(); ++j)
    if (followed.lost[j] > 0 && faces(before[j].wall, before[j].normal)) parts.push_back({&before[j], each * followed.lost[j]});
}

/// The bands of the largest part, with the others added.
WallContacts::Bands WallContacts::bands_of(std::span<const Part> parts, std::span<const Touch> before,
                                           std::span<const Bands> bands, const Vector3& normal) const {
  if (parts.empty()) return {};
  const auto in_plane = [&](const Part& part) {
    Bands found = bands[static_cast<std::size_t>(part.touch - before.data())];
    for (Vector3& stretch : found.stretch) stretch = turned(part.weight * stretch, part.touch->normal, normal);
    return found;
  };
  const auto largest = std::ranges::max_element(parts, {}, &Part::weight);
  Bands sum = in_plane(*largest);
  for (auto part = parts.begin(); part != parts.end(); ++part)
    if (part != largest) add(sum, in_plane(*part));
  return sum;
}

/// The points of a sphere from a number on become touches, with what those `before` remember.
void WallContacts::take_points(Index sphere, std::size_t begin, std::span<Touch> before, Tile& tile) const {
  thread_local Followed followed;
  thread_local std::vector<Part> parts;
  follow(begin, before, tile.points, followed);
  const auto points = std::span(tile.points).subspan(begin);
  const bool slips_in_part = table_.slips_in_part();
  const auto bands_before =
      slips_in_part && !before.empty()
          ? std::span(tile.bands_before).subspan(static_cast<std::size_t>(before.data() - tile.before.data()), before.size())
          : std::span<Bands>{};
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Point& point = points[n];
    Touch touch{.sphere = sphere, .wall = point.wall, .normal = point.normal};
    parts.clear();
    if (point.share > 0) {
      touch.share = point.share;
      find_parts(n, points, before, followed, parts);
    }
    for (const auto& [old, weight] : parts) {
      touch.sliding += turned(weight * old->sliding, old->normal, point.before);
      touch.rolling += turned(weight * old->rolling, old->normal, point.before);
      touch.twisting += weight * old->twisting;
    }
    tile.touches.push_back(touch);
    if (slips_in_part) tile.bands.push_back(bands_of(parts, before, bands_before, point.before));
  }
}

}  // namespace sazare::methods::spheres
