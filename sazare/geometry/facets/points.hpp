#pragma once

/// The points of a surface that count in the contact of a sphere, see FacetComplex. The parts that are nearest in one point count
/// there together; where that is nothing, as in most of them, there is no contact.
///
/// A point may count less than nothing, as the edge of a crease that the sphere reaches does. Its force is then taken off those
/// of the points beside it as far as the normals allow, so that each has a `share` between 0 and what it counts. Shares say how
/// much friction and damping there is in a point: they begin and end at 0 where a point begins and ends at an overlap.

#include "sazare/geometry/facets/complex.hpp"

namespace sazare::geometry {

/// A facet within reach, and where it is nearest to the centre.
struct NearFacet {
  Index facet = 0;
  TrianglePoint point;
  Real distance = 0;  ///< of that point [m]
};

struct FacetPoint {
  Index facet = 0;  ///< one to which it belongs
  Vector3 place = Vector3::Zero();
  Vector3 normal = Vector3::Zero();  ///< to the centre
  Real distance = 0;                 ///< [m]
  Real count = 0;
  Real share = 0;
  Vector3 slope = Vector3::Zero();   ///< of the count as the centre moves [1/m]
};

class FacetPoints {
public:
  /// Where a vertex is now [m].
  template <class PlaceOf>
  void find(const FacetComplex& complex, const PlaceOf& place_of, const Vector3& centre, Real radius, Real reach,
            std::span<const NearFacet> facets);

  /// The deepest first.
  std::span<const FacetPoint> points() const { return points_; }

private:
  enum class Part { facet, edge, vertex };
  struct Spot {
    Part part = Part::facet;
    Index number = 0;
    FacetPoint at;
  };
  /// A part that was looked at, and the place among the spots of its nearest point; -1 beyond reach.
  struct Seen {
    Index number = 0;
    int spot = -1;
  };
  struct View {
    const FacetComplex* complex;
    Vector3 centre;
    Real radius, reach;
  };

  int spot(const View& view, Part part, Index number, Index facet, const Vector3& place);
  template <class PlaceOf>
  int nearest_on_edge(const View& view, const PlaceOf& place_of, Index number, Index facet);
  template <class PlaceOf>
  int nearest_on_facet(const View& view, const PlaceOf& place_of, const NearFacet& near);
  template <class PlaceOf>
  void add_edge(const View& view, const PlaceOf& place_of, Index number, Index facet);
  template <class PlaceOf>
  void add_vertex(const View& view, const PlaceOf& place_of, Index number, Index facet);
  void add_apart(const View& view, Real apart, const Vector3& from, const Vector3& inward, Real ramp, int spot, Real times);
  static bool has(std::span<const Seen> seen, Index number);
  int spot_of_facet(Index facet) const;
  void share_out(const View& view);
  void take_off(const View& view, const Spot& from, Real count, int one, int other);
  void conclude(const View& view);

  std::vector<Spot> spots_;
  std::vector<Seen> facets_, edges_, vertices_;
  std::vector<FacetPoint> points_;
};

template <class PlaceOf>
int FacetPoints::nearest_on_edge(const View& view, const PlaceOf& place_of, Index number, Index facet) {
  const FacetComplex::Edge& edge = view.complex->edges()[static_cast<std::size_t>(number)];
  const Vector3 from = place_of(edge.ends[0]), to = place_of(edge.ends[1]), along = to - from;
  const Real part = (view.centre - from).dot(along), whole = along.squaredNorm();
  if (part <= 0) return spot(view, Part::vertex, edge.ends[0], facet, from);
  if (part >= whole) return spot(view, Part::vertex, edge.ends[1], facet, to);
  return spot(view, Part::edge, number, facet, from + part / whole * along);
}

template <class PlaceOf>
int FacetPoints::nearest_on_facet(const View& view, const PlaceOf& place_of, const NearFacet& near) {
  const FacetComplex::Facet& facet = view.complex->facets()[static_cast<std::size_t>(near.facet)];
  if (near.point.part == 6) return spot(view, Part::facet, near.facet, near.facet, near.point.place);
  if (near.point.part < 3) {
    const Index corner = facet.corners[static_cast<std::size_t>(near.point.part)];
    return spot(view, Part::vertex, corner, near.facet, place_of(corner));
  }
  int best = -1;
  for (const Index edge : view.complex->edges_of_side(facet, near.point.part - 3)) {
    const int found = nearest_on_edge(view, place_of, edge, near.facet);
    if (best < 0 || (found >= 0 && spots_[static_cast<std::size_t>(found)].at.distance <
                                       spots_[static_cast<std::size_t>(best)].at.distance))
      best = found;
  }
  return best;
}

template <class PlaceOf>
void FacetPoints::add_edge(const View& view, const PlaceOf& place_of, Index number, Index facet) {
  const FacetComplex::Edge& edge = view.complex->edges()[static_cast<std::size_t>(number)];
  if ((edge.count == 0 && edge.apart == 0) || has(edges_, number)) return;
  const int at = nearest_on_edge(view, place_of, number, facet);
  edges_.push_back({number, at});
  if (at < 0) return;
  spots_[static_cast<std::size_t>(at)].at.count += edge.count;
  if (edge.apart == 0) return;
  const Vector3 from = place_of(edge.ends[0]);
  add_apart(view, edge.apart, from, edge.inward, 0.5 * view.radius, at, 1);
  for (const Index end : edge.ends)
    add_apart(view, edge.apart, from, edge.inward, 0.5 * view.radius, spot(view, Part::vertex, end, facet, place_of(end)), -0.5);
}

template <class PlaceOf>
void FacetPoints::add_vertex(const View& view, const PlaceOf& place_of, Index number, Index facet) {
  const FacetComplex::Vertex& vertex = view.complex->vertices()[static_cast<std::size_t>(number)];
  if ((vertex.count == 0 && vertex.apart == 0) || has(vertices_, number)) return;
  const Vector3 place = place_of(number);
  const int at = spot(view, Part::vertex, number, facet, place);
  vertices_.push_back({number, at});
  if (at < 0) return;
  spots_[static_cast<std::size_t>(at)].at.count += vertex.count;
  if (vertex.apart > 0)
    add_apart(view, vertex.apart, place, vertex.inward, std::min(vertex.ramp, 0.5 * view.radius), at, 1);
}

template <class PlaceOf>
void FacetPoints::find(const FacetComplex& complex, const PlaceOf& place_of, const Vector3& centre, Real radius, Real reach,
                       std::span<const NearFacet> facets) {
  points_.clear();
  const NearFacet& only = facets.front();
  if (facets.size() == 1 && !complex.facets()[static_cast<std::size_t>(only.facet)].joins_plane) {  // no part is shared
    const Vector3& place = only.point.place;
    points_.push_back({only.facet, place, (centre - place) / only.distance, only.distance, 1, 1, Vector3::Zero()});
    return;
  }
  const View view{&complex, centre, radius, reach};
  spots_.clear();
  facets_.clear();
  edges_.clear();
  vertices_.clear();
  for (const NearFacet& near : facets) {
    const int at = nearest_on_facet(view, place_of, near);
    facets_.push_back({near.facet, at});
    if (at >= 0) spots_[static_cast<std::size_t>(at)].at.count += 1;
  }
  for (const NearFacet& near : facets) {
    const FacetComplex::Facet& facet = complex.facets()[static_cast<std::size_t>(near.facet)];
    for (const Index edge : complex.edges_of(facet)) {
      add_edge(view, place_of, edge, near.facet);
      for (const Index end : complex.edges()[static_cast<std::size_t>(edge)].ends) add_vertex(view, place_of, end, near.facet);
    }
  }
  share_out(view);
  conclude(view);
}

}  // namespace sazare::geometry
