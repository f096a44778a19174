#include "sazare/geometry/facets/complex.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "sazare/geometry/place_cells.hpp"

namespace sazare::geometry {

namespace {

constexpr Real flat = 1e-5;                          // angle below which two facets count as lying in one plane [rad]
constexpr Real right_angle = 0.5 * std::numbers::pi;  // from which on two facets count as apart

using Pair = std::array<Index, 2>;
Pair sorted(Index one, Index other) { return {std::min(one, other), std::max(one, other)}; }

/// Makes vertices of places; those that are nearer than `same_place` are one.
class Welder {
public:
  explicit Welder(Real same_place) : same_place_(same_place), cells_(same_place) {}

  /// The vertex at a place, which may be new.
  Index vertex(const Vector3& place, std::vector<FacetComplex::Vertex>& vertices) {
    Index same = -1;
    cells_.visit_near(place, [&](Index known) {
      if (same < 0 && (vertices[at(known)].place - place).norm() <= same_place_) same = known;
    });
    if (same >= 0) return same;
    const auto number = static_cast<Index>(vertices.size());
    vertices.emplace_back().place = place;
    cells_.add(number, place);
    return number;
  }

private:
  Real same_place_;
  PlaceCells cells_;
};

/// Vertices of the outlines, for questions which of them lie on a side.
class OnSides {
public:
  OnSides(const std::vector<FacetComplex::Vertex>& vertices, const std::set<Index>& outline, Real same_place)
      : vertices_(vertices), same_place_(same_place), order_(outline.begin(), outline.end()) {
    std::ranges::stable_sort(order_, {}, [&](Index one) { return vertices_[at(one)].place.x(); });
  }

  /// From one end to the other, with both.
  std::vector<Index> along(Index from, Index to) const {
    const Vector3 &a = vertices_[at(from)].place, way = vertices_[at(to)].place - a;
    const Real low = std::min(a.x(), a.x() + way.x()) - same_place_, high = std::max(a.x(), a.x() + way.x()) + same_place_;
    std::vector<std::pair<Real, Index>> found;
    const auto begin = std::ranges::lower_bound(order_, low, {}, [&](Index one) { return vertices_[at(one)].place.x(); });
    for (auto one = begin; one != order_.end() && vertices_[at(*one)].place.x() <= high; ++one) {
      if (*one == from || *one == to) continue;
      const Vector3 there = vertices_[at(*one)].place - a;
      const Real part = there.dot(way) / way.squaredNorm();
      if (part > 0 && part < 1 && (there - part * way).norm() <= same_place_) found.emplace_back(part, *one);
    }
    std::ranges::sort(found);
    std::vector<Index> all = {from};
    for (const auto& [part, vertex] : found) all.push_back(vertex);
    all.push_back(to);
    return all;
  }

private:
  const std::vector<FacetComplex::Vertex>& vertices_;
  Real same_place_;
  std::vector<Index> order_;
};

}  // namespace

FacetComplex::FacetComplex(std::span<const Triangle> triangles, Real same_place, std::span<const PlaneInSpace> planes) {
  Welder welder(same_place);
  for (const Triangle& triangle : triangles) {
    Facet& facet = facets_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) facet.corners[k] = welder.vertex(triangle[k], vertices_);
  }
  leave_out_twins(same_place);
  join(same_place);
  count(same_place, planes);
  see_concave_edges();
  see_outline_corners();
}

FacetComplex::FacetComplex(std::span<const Vector3> nodes, std::span<const std::array<Index, 3>> facets) {
  for (const Vector3& node : nodes) vertices_.emplace_back().place = node;
  for (const auto& corners : facets) facets_.emplace_back().corners = corners;
  leave_out_twins(0);
  join(0);
  count(0, {});
  see_concave_edges();
  see_outline_corners();
}

/// A facet that is there twice counts once, and one as thin as a line not at all.
void FacetComplex::leave_out_twins(Real same_place) {
  std::set<std::array<Index, 3>> known;
  for (Facet& facet : facets_) {
    std::array<Index, 3> corners = facet.corners;
    std::ranges::sort(corners);
    const bool is_new = corners[0] != corners[1] && corners[1] != corners[2] && known.insert(corners).second;
    const Vector3 &a = vertices_[at(corners[0])].place, ab = vertices_[at(corners[1])].place - a,
                  ac = vertices_[at(corners[2])].place - a;
    const Real longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    facet.count = is_new && ab.cross(ac).norm() > same_place * longest ? 1 : 0;
  }
}

/// Makes the edges. Sides that one facet has alone are cut at the vertices of others that lie on them.
void FacetComplex::join(Real same_place) {
  std::map<Pair, int> uses;
  const auto visit_sides = [&](auto&& visit) {
    for (Facet& facet : facets_)
      for (std::size_t k = 0; k < 3; ++k) visit(facet, k, facet.corners[k], facet.corners[(k + 1) % 3]);
  };
  visit_sides([&](const Facet& facet, std::size_t, Index from, Index to) { uses[sorted(from, to)] += facet.count > 0 ? 1 : 0; });
  std::set<Index> outline;
  if (same_place > 0)
    for (const auto& [ends, count] : uses)
      if (count == 1) outline.insert(ends.begin(), ends.end());
  const OnSides on_sides(vertices_, outline, same_place);
  std::map<Pair, Index> numbers;
  visit_sides([&](Facet& facet, std::size_t side, Index from, Index to) {
    facet.sides[side] = static_cast<Index>(edge_numbers_.size());
    facet.sides[side + 1] = facet.sides[side];
    if (facet.count == 0) return;
    const bool alone = !outline.empty() && uses[sorted(from, to)] == 1;
    const std::vector<Index> stops = alone ? on_sides.along(from, to) : std::vector<Index>{from, to};
    for (std::size_t n = 0; n + 1 < stops.size(); ++n) {
      const Pair ends = sorted(stops[n], stops[n + 1]);
      const auto [found, is_new] = numbers.emplace(ends, static_cast<Index>(edges_.size()));
      if (is_new) edges_.emplace_back().ends = ends;
      Edge& edge = edges_[at(found->second)];
      if (edge.facet_count < 2) edge.facets[at(edge.facet_count)] = static_cast<Index>(&facet - facets_.data());
      ++edge.facet_count;
      edge_numbers_.push_back(found->second);
    }
    facet.sides[side + 1] = static_cast<Index>(edge_numbers_.size());
  });
}

/// What contains a part counts before it: from planes and facets down to vertices. Planes count as one.
void FacetComplex::count(Real same_place, std::span<const PlaneInSpace> planes) {
  const auto in_a_plane = [&](auto... vertex) {
    return std::ranges::any_of(planes, [&](const PlaneInSpace& plane) {
      return ((std::abs((vertices_[at(vertex)].place - plane.point).dot(plane.normal)) <= same_place) && ...);
    });
  };
  for (Vertex& vertex : vertices_) vertex.count = 1;
  for (Facet& facet : facets_) {
    if (facet.count > 0 && in_a_plane(facet.corners[0], facet.corners[1], facet.corners[2])) facet.count = 0;
    facet.joins_plane = std::ranges::any_of(facet.corners, in_a_plane);
  }
  for (Index number = 0; number < static_cast<Index>(vertices_.size()); ++number)
    if (in_a_plane(number)) vertices_[at(number)].count = 0;
  for (Edge& edge : edges_) {
    edge.count = in_a_plane(edge.ends[0], edge.ends[1]) ? 0 : 1;
    edge.facet_count = 0;
  }
  for (const Facet& facet : facets_) {
    if (facet.count == 0) continue;
    std::set<Index> of_facet;
    for (const Index number : edges_of(facet)) {
      edges_[at(number)].count -= 1;
      ++edges_[at(number)].facet_count;
      of_facet.insert(edges_[at(number)].ends.begin(), edges_[at(number)].ends.end());
    }
    for (const Index vertex : of_facet) vertices_[at(vertex)].count -= 1;
  }
  for (const Edge& edge : edges_)
    for (const Index end : edge.ends) vertices_[at(end)].count -= edge.count;
}

/// The unit vector in the plane of a facet that points across one of its edges into it.
Vector3 FacetComplex::across(const Edge& edge, Index facet) const {
  const auto& corners = facets_[at(facet)].corners;
  const Vector3 &from = vertices_[at(edge.ends[0])].place, along = (vertices_[at(edge.ends[1])].place - from).normalized();
  Vector3 into = Vector3::Zero();
  for (const Index corner : corners) {
    const Vector3 there = vertices_[at(corner)].place - from, beside = there - there.dot(along) * along;
    if (beside.squaredNorm() > into.squaredNorm()) into = beside;
  }
  return into.normalized();
}

void FacetComplex::see_concave_edges() {
  for (Edge& edge : edges_) {
    if (edge.count != -1 || edge.facet_count != 2 || facets_[at(edge.facets[0])].count == 0 ||
        facets_[at(edge.facets[1])].count == 0)
      continue;
    const Vector3 one = across(edge, edge.facets[0]), other = across(edge, edge.facets[1]);
    const Real angle = std::atan2(one.cross(other).norm(), -one.dot(other));
    if (angle < flat) continue;
    edge.apart = std::min(angle / right_angle, Real{1});
    edge.inward = (one + other).normalized();
  }
}

void FacetComplex::see_outline_corners() {
  std::vector<Real> angle(vertices_.size(), 0);  // that facets fill
  std::vector<std::vector<Index>> open(vertices_.size());
  for (const Edge& edge : edges_)
    if (edge.facet_count == 1 && edge.count == 0)
      for (const Index end : edge.ends) open[at(end)].push_back(edge.ends[0] == end ? edge.ends[1] : edge.ends[0]);
  for (const Facet& facet : facets_) {
    if (facet.count == 0) continue;
    for (int side = 0; side < 3; ++side) {
      const Index corner = facet.corners[at(side)];
      const Vector3 &here = vertices_[at(corner)].place, one = vertices_[at(facet.corners[at((side + 1) % 3)])].place - here,
                    other = vertices_[at(facet.corners[at((side + 2) % 3)])].place - here;
      angle[at(corner)] += std::atan2(one.cross(other).norm(), one.dot(other));
      const std::span<const Index> edges = edges_of_side(facet, side);
      for (std::size_t n = 0; n + 1 < edges.size(); ++n) {  // a vertex on the side
        const Pair &before = edges_[at(edges[n])].ends, &after = edges_[at(edges[n + 1])].ends;
        const Index shared = before[0] == after[0] || before[0] == after[1] ? before[0] : before[1];
        angle[at(shared)] += std::numbers::pi;
      }
    }
  }
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    const Real turn = angle[v] - std::numbers::pi;
    if (open[v].size() != 2 || turn < flat) continue;
    Vertex& vertex = vertices_[v];
    const Vector3 one = vertices_[at(open[v][0])].place - vertex.place, other = vertices_[at(open[v][1])].place - vertex.place;
    vertex.apart = std::min(turn / right_angle, Real{1});
    vertex.inward = (one.normalized() + other.normalized()).normalized();
    vertex.ramp = 0.5 * std::min(one.norm(), other.norm());
  }
}

}  // namespace sazare::geometry
