/// Which walls are one surface, and where a sphere touches it.

#include <algorithm>

#include "sazare/methods/spheres/wall_contacts.hpp"

namespace sazare::methods::spheres {

namespace {

constexpr Real same_place = 1e-6;  // of the largest radius

bool are_joined(const Wall& one, const Wall& other) {
  return one.joined >= 0 && one.joined == other.joined && one.images.lower == other.images.lower &&
         one.images.length == other.images.length;
}

bool lies_in(const Wall& one, const Wall& other, Real distance) {
  return (one.normal - other.normal).norm() <= same_place && std::abs((one.point - other.point).dot(other.normal)) <= distance;
}

}  // namespace

/// A plane that is there twice counts once.
void WallContacts::join_walls() {
  surface_of_.assign(walls_.size(), no_surface);
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    std::vector<Index> planes;
    for (std::size_t v = 0; v < walls_.size(); ++v)
      if (v != w && are_joined(walls_[v], walls_[w]) && walls_[v].is_plane()) planes.push_back(static_cast<Index>(v));
    if (walls_[w].is_plane()) {
      for (const Index v : planes)
        if (v < static_cast<Index>(w) && lies_in(walls_[w], walls_[static_cast<std::size_t>(v)], same_place * reach_))
          surface_of_[w] = lies_in_another;
      continue;
    }
    if (surface_of_[w] >= 0) continue;
    Surface& surface = surfaces_.emplace_back();
    for (std::size_t v = w; v < walls_.size(); ++v)
      if (v == w || (walls_[v].is_surface() && are_joined(walls_[v], walls_[w]))) {
        surface_of_[v] = static_cast<Index>(surfaces_.size()) - 1;
        surface.walls.push_back(static_cast<Index>(v));
      }
    build(surface, planes);
  }
}

/// Corners that are one vertex are put in one place.
void WallContacts::build(Surface& surface, std::span<const Index> planes) {
  std::vector<geometry::Triangle> triangles;
  for (const Index wall : surface.walls) {
    const auto& more = walls_[static_cast<std::size_t>(wall)].triangles;
    surface.first.push_back(static_cast<Index>(triangles.size()));
    triangles.insert(triangles.end(), more.begin(), more.end());
  }
  std::vector<geometry::PlaneInSpace> at;
  for (const Index wall : planes) {
    const Wall& plane = walls_[static_cast<std::size_t>(wall)];
    at.push_back({plane.point, plane.normal});
  }
  surface.complex = geometry::FacetComplex(triangles, same_place * reach_, at);
  for (std::size_t n = 0; n < surface.walls.size(); ++n) {
    auto& own = walls_[static_cast<std::size_t>(surface.walls[n])].triangles;
    for (std::size_t t = 0; t < own.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& facet = surface.complex.facets()[static_cast<std::size_t>(surface.first[n]) + t];
        own[t][k] = surface.complex.vertices()[static_cast<std::size_t>(facet.corners[k])].place;
      }
  }
}

/// Adds the points where the sphere touches surfaces to which `near` belongs, and sees whether it went through a surface.
void WallContacts::find_points(const state::Spheres& spheres, const Vector3& place, std::span<Near> near, Tile& tile) const {
  thread_local std::vector<Reached> reached;
  thread_local std::vector<geometry::NearFacet> facets;
  reached.clear();
  const auto sphere = static_cast<std::size_t>(near.front().sphere);
  const Real radius = spheres.place[sphere].radius;
  const auto material = static_cast<Index>(spheres.spin[sphere].material);
  const bool adheres = table_.adheres();
  const auto reach_to = [&](Index wall) {
    return adheres ? radius + table_.neck(material, walls_[static_cast<std::size_t>(wall)].material, radius) : radius;
  };
  const auto reach = [&](Near& one, const geometry::Triangle& corners) {
    const auto w = static_cast<std::size_t>(one.wall);
    const Vector3 centre = seen_by(w, place);
    const geometry::TrianglePoint point = geometry::nearest_on(corners, centre);
    const Real distance = (centre - point.place).norm();
    if (went_through(one, corners, centre, distance, spheres.box) && !tile.passage)
      tile.passage = {spheres.number[sphere], one.wall, place, time_};
    if (!(distance < reach_to(one.wall)) || !(distance > 0)) return;
    const Surface& surface = surfaces_[static_cast<std::size_t>(surface_of_[w])];
    const auto among = static_cast<std::size_t>(std::ranges::find(surface.walls, one.wall) - surface.walls.begin());
    const Index facet = surface.first[among] + one.triangle;
    if (surface.complex.facets()[static_cast<std::size_t>(facet)].count > 0)
      reached.push_back({surface_of_[w], {facet, point, distance}});
  };
  for (Near& one : near) {
    const auto w = static_cast<std::size_t>(one.wall);
    if (w == surface_)
      reach(one, triangle(w, one.triangle));
    else
      reach(one, walls_[w].triangles[static_cast<std::size_t>(one.triangle)]);
  }
  const auto by_surface = [](const Reached& a, const Reached& b) { return a.surface < b.surface; };
  if (!std::ranges::is_sorted(reached, by_surface)) std::ranges::stable_sort(reached, by_surface);
  for (auto from = reached.begin(); from != reached.end();) {
    const Index surface = from->surface;
    facets.clear();
    for (; from != reached.end() && from->surface == surface; ++from) facets.push_back(from->facet);
    add_points(surface, place, radius, reach_to(surfaces_[static_cast<std::size_t>(surface)].walls.front()), facets, tile.points);
  }
}

/// Adds the points of one surface of which these facets are within reach.
void WallContacts::add_points(Index number, const Vector3& place, Real radius, Real reach,
                              std::span<const geometry::NearFacet> facets, std::vector<Point>& points) const {
  thread_local geometry::FacetPoints found;
  const Surface& surface = surfaces_[static_cast<std::size_t>(number)];
  const auto w = static_cast<std::size_t>(surface.walls.front());
  const Vector3 centre = seen_by(w, place);
  const auto node = [&](Index vertex) { return walls_[w].nodal.place(vertex, time_); };
  const auto corner = [&](Index vertex) { return surface.complex.vertices()[static_cast<std::size_t>(vertex)].place; };
  if (w == surface_)
    found.find(surface.complex, node, centre, radius, reach, facets);
  else
    found.find(surface.complex, corner, centre, radius, reach, facets);
  for (const geometry::FacetPoint& one : found.points()) {
    const auto after = std::ranges::upper_bound(surface.first, one.facet) - 1;
    points.push_back({surface.walls[static_cast<std::size_t>(after - surface.first.begin())], one.facet - *after,
                      radius - one.distance, place, one.place, poses_[w].direction_out(one.normal), one.count, one.share,
                      poses_[w].direction_out(one.slope)});
  }
}

}  // namespace sazare::methods::spheres
