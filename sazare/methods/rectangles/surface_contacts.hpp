#pragma once

/// Elements on a surface whose nodes move: straight segments in the plane, with the elements on their left.
///
/// Where a free face of an element lies below a segment, springs along the segment push it out:
///
///     f = k int d dt           t   along the segment, as far as the face lies below it [m]
///     E = k/2 int d^2 dt       d   depth of the face there [m]
///                              k   2 k_n l / a: what the longest side a of the element has on a wall, spread over it [N/m2]
///
/// So the force is the derivative of the energy, and it does not matter where the surface is cut into segments. What lies nearer
/// to another segment is left to that one. A circle has one point: its foot on a segment, or a node between two of which it has
/// none. Dashpots act beside the springs; along each face one spring serves all its points and slips: laws/face_contact.hpp.
/// Forces go to the nodes of a segment by its linear shape functions.

#include <array>
#include <span>
#include <vector>

#include "sazare/geometry/nodal_surface.hpp"
#include "sazare/methods/rectangles/contacts.hpp"

namespace sazare::methods::rectangles {

class SurfaceContacts {
public:
  using Segment = std::array<Index, 2>;

  /// Segments by numbers of nodes.
  SurfaceContacts(const ContactRules& rules, const std::vector<Vector3>& nodes, std::vector<Segment> segments,
                  const state::Particles<2>& particles, const state::Outlines& outlines);

  /// From now on the nodes go from these places with these velocities [m; m/s].
  void lead(Real step, std::vector<Vector3> from, std::vector<Vector3> with);

  /// All forces, `elapsed` after those before. `moved`: what has moved so far that an element may be near which was not.
  void evaluate(const state::Particles<2>& particles, const state::Outlines& outlines, bool moved, Real elapsed);

  /// Adds the force [N] and moment [N m] on an element.
  void add_to(std::size_t element, std::array<Real, 3>& sum) const;
  bool has(std::size_t element) const { return place_of_[element] >= 0; }

  const geometry::SurfaceNodes& nodes() const { return nodes_; }
  Index touching() const;  ///< faces of elements
  Real elastic_energy() const;
  SpringLosses losses() const;
  /// Work of the surface on the elements [J].
  Real work() const { return past_work_ + nodes_.work(); }

  void columns(Archive& archive);

private:
  /// A face of an element that touches.
  struct Touch {
    std::int64_t face = 0;
    Real shear = 0;   ///< force of its shear spring on the element along (n_y, -n_x) [N]
    Real energy = 0;  ///< in that spring [J]
  };

  /// Where it is pushed.
  struct Point {
    Index touch = 0, segment = 0;
    Real share = 0;                                       ///< of the segment's second node
    Real elastic = 0;                                     ///< of the springs [N]
    Real weight = 0;                                      ///< of the element's dashpot that acts here
    geometry::Vector2 place = geometry::Vector2::Zero();  ///< [m]
    geometry::Vector2 normal = geometry::Vector2::Zero();
    geometry::Vector2 force = geometry::Vector2::Zero();    ///< on the element [N]
    geometry::Vector2 dashpot = geometry::Vector2::Zero();  ///< of it, what the dashpots gave
  };

  /// An element near the surface.
  struct Near {
    Index element = 0;
    std::vector<Index> segments;
    std::vector<Touch> touches;
    std::vector<Point> points;
    std::array<Real, 3> force{}, dashpot{};  ///< on the element, and of that what the dashpots gave [N], [N m]
    Real dashpot_power = 0;                  ///< which they took when they were evaluated [W]
    Real elastic = 0;                        ///< in its springs [J]
    SpringLosses loss;
  };

  /// A segment as it lies now.
  struct Line {
    geometry::Vector2 from, along, normal;
    Real length = 0;
  };

  /// A face below a segment, from one place along it to another.
  struct Piece {
    Index segment = 0;
    int face = 0;
    std::array<Real, 2> at{}, depth{};
  };

  Line line(Index segment) const;
  void search(const state::Particles<2>& particles, const state::Outlines& outlines);
  void evaluate(const state::Particles<2>& particles, const state::Outlines& outlines, Near& near, Real elapsed) const;
  void find_pieces(const geometry::Outline& outline, std::span<const Index> segments, std::vector<Piece>& pieces) const;
  void add_pieces(const geometry::Outline& outline, Index segment, std::vector<Piece>& pieces) const;
  bool is_nearer_elsewhere(const Piece& piece, std::span<const Index> segments) const;
  void add_points(const geometry::Outline& outline, Near& near) const;
  void add_circle(const geometry::Outline& outline, Near& near) const;
  laws::ContactSprings springs_of(Real mass) const;
  void push(const state::Particles<2>& particles, Index touch, Real elapsed, Near& near) const;
  const Segment& nodes_of(const Point& point) const { return segments_[static_cast<std::size_t>(point.segment)]; }
  geometry::Vector2 velocity(const Point& point) const;
  Real power_of_nodes(const Near& near) const;
  Real dashpot_power(const state::Particles<2>& particles, const Near& near) const;

  ContactRules rules_;
  std::vector<Segment> segments_;
  std::vector<std::array<Index, 2>> beside_;  ///< by segment: those that end where it begins and begin where it ends, or -1
  geometry::SurfaceNodes nodes_;
  Real time_ = 0;              ///< since the nodes were led last [s]
  Real skin_ = 0, drift_ = 0;  ///< drift: of any node since the last search, at most [m]
  bool searched_ = false;
  std::vector<Near> near_;       ///< by element
  std::vector<Index> place_of_;  ///< by element: its place in `near_`, or -1
  SpringLosses past_losses_;     ///< of elements that are not near any more
  Real past_work_ = 0;           ///< until the nodes were led last [J]
};

}  // namespace sazare::methods::rectangles
