#pragma once

/// A surface of triangles as facets, edges and vertices, each with the number by which it counts in the contact of a sphere:
///
///     E(x) = sum over the parts s of c_s U(R - d_s(x))        d_s   distance of the centre x from s, which is closed [m]
///                                                             U(d)  energy of the contact law at the overlap d [J]
///
/// The counts c are such that those of all parts that contain a point sum up to 1: of a closed surface 1 for facets, -1 for
/// edges, 1 for vertices. So E is U(R - d) with d the distance from the surface wherever what the sphere reaches of it is one
/// patch without holes, as on a flat or convex surface; where it is two patches, as the sides of a groove, both count. Distances
/// from convex parts have continuous derivatives, so the force does too, whatever numbers the c are.
///
/// At a concave edge, between two facets that are apart by the angle `a` from lying in one plane, c is -(1 - z), z = 2 a/pi, at
/// most 1; half of that z is taken off each end. Without it a ring, as of a funnel or a hole of many facets, would count
/// nothing: as many edges as facets. It counts on the concave side alone, from half a radius above the edge on as a whole. At a
/// corner of the outline of a plate that points into the plate, as of a hole, the vertex gets z for the same reason. See
/// docs/theory/spheres.md.

#include <array>
#include <span>
#include <vector>

#include "sazare/core/time.hpp"
#include "sazare/geometry/triangle.hpp"

namespace sazare::geometry {

struct PlaneInSpace {
  Vector3 point, normal;  ///< the normal of length 1
};

class FacetComplex {
public:
  struct Facet {
    std::array<Index, 3> corners{};  ///< vertices
    std::array<Index, 4> sides{};    ///< where the edges of each side begin among those of all, and where the last ends
    Real count = 0;                  ///< 0: another part has all of it
    bool joins_plane = false;        ///< so that parts of it may count where it alone is within reach
  };
  struct Edge {
    std::array<Index, 2> ends{};          ///< vertices
    std::array<Index, 2> facets{-1, -1};  ///< two of those that have it
    Index facet_count = 0;
    Real count = 0;
    Real apart = 0;                    ///< z
    Vector3 inward = Vector3::Zero();  ///< across the edge into the concave side
  };
  struct Vertex {
    Vector3 place = Vector3::Zero();  ///< at the start [m]
    Real count = 0;
    Real apart = 0;                    ///< z of a corner of the outline
    Real ramp = 0;                     ///< over which that begins to count [m]
    Vector3 inward = Vector3::Zero();  ///< in the plate's plane, away from it
  };

  FacetComplex() = default;
  /// Corners nearer than `same_place` [m] are one vertex, and a side is cut where a corner of another triangle lies on it. What
  /// lies in a plane counts there already.
  FacetComplex(std::span<const Triangle> triangles, Real same_place, std::span<const PlaneInSpace> planes = {});
  /// Facets between nodes, which are joined where they share these.
  FacetComplex(std::span<const Vector3> nodes, std::span<const std::array<Index, 3>> facets);

  const std::vector<Facet>& facets() const { return facets_; }
  const std::vector<Edge>& edges() const { return edges_; }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  std::span<const Index> edges_of(const Facet& facet) const { return edges_of_sides(facet, 0, 3); }
  std::span<const Index> edges_of_side(const Facet& facet, int side) const { return edges_of_sides(facet, side, side + 1); }

private:
  std::span<const Index> edges_of_sides(const Facet& facet, int from, int to) const {
    const auto begin = static_cast<std::size_t>(facet.sides[static_cast<std::size_t>(from)]),
               end = static_cast<std::size_t>(facet.sides[static_cast<std::size_t>(to)]);
    return std::span(edge_numbers_).subspan(begin, end - begin);
  }
  void leave_out_twins(Real same_place);
  void join(Real same_place);
  void count(Real same_place, std::span<const PlaneInSpace> planes);
  void see_concave_edges();
  void see_outline_corners();
  Vector3 across(const Edge& edge, Index facet) const;

  std::vector<Facet> facets_;
  std::vector<Edge> edges_;
  std::vector<Vertex> vertices_;
  std::vector<Index> edge_numbers_;  ///< by side of facet
};

}  // namespace sazare::geometry
