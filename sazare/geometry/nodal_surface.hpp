#pragma once

/// A surface whose corners are the nodes of a continuum: each moves on its own, with a velocity that stays for a while. A point
/// of a triangle, or of a segment in the plane, moves as its linear shape functions say, and what pushes it there is shared among
/// the corners by the same functions, so that force, moment and work are kept.

#include <array>
#include <span>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/time.hpp"
#include "sazare/geometry/facets/complex.hpp"

namespace sazare::geometry {

/// What a point of a face is told and tells.
struct FacePoint {
  std::array<Index, 3> nodes{};
  geometry::Triangle corners;
  std::array<Real, 3> shares{};  ///< shape functions of the corners
  std::array<Vector3, 3> velocities;

  Vector3 velocity() const {
    return shares[0] * velocities[0] + shares[1] * velocities[1] + shares[2] * velocities[2];  // [m/s]
  }

  /// How fast the face turns, as the rigid motion nearest to that of its corners [rad/s].
  Vector3 spin() const;

  /// What a force at the point and a couple are on the corners [N]; with that spin, the couple does its work.
  std::array<Vector3, 3> on_corners(const Vector3& force, const Vector3& couple) const;
};

/// A force on a node of a surface.
struct NodeForce {
  Index node = 0;
  Vector3 force = Vector3::Zero();  ///< [N]
};

/// The nodes: where they are, and what they get.
class SurfaceNodes {
public:
  SurfaceNodes() = default;
  /// At rest [m].
  explicit SurfaceNodes(std::vector<Vector3> places);

  Vector3 place(Index node, Real time) const { return places_[at(node)] + (time - since_) * velocities_[at(node)]; }  ///< [m]
  std::size_t node_count() const { return places_.size(); }
  const Vector3& velocity(Index node) const { return velocities_[at(node)]; }                                         ///< [m/s]
  Real largest_speed() const { return largest_speed_; }

  /// Nodes go on from here with other velocities. The work of the last force was added as if the old ones stayed; it acts half of
  /// its step with the new ones, and what that changes of the surface's work on the bodies is returned [J].
  Real lead(Real time, Real step, std::vector<Vector3> from, std::vector<Vector3> with);

  /// Takes the forces at a time, a step after those before.
  void add_work(std::span<const NodeForce> forces, Real step);

  const std::vector<Vector3>& force() const { return force_; }  ///< as last given to `add_work` [N]
  /// Since the last `lead`, of the mean of two forces over the step between them [N s].
  const std::vector<Vector3>& impulse() const { return impulse_; }
  /// Work of the surface on the bodies since the last `lead` [J].
  Real work() const;

  void columns(Archive& archive);

private:
  void measure();

  std::vector<Vector3> places_;      ///< at `since_` [m]
  std::vector<Vector3> velocities_;  ///< from then on [m/s]
  Real since_ = 0, largest_speed_ = 0;
  std::vector<Vector3> force_, impulse_;
  std::vector<Index> touched_;  ///< nodes with a force
  std::vector<char> is_touched_;
};

/// With its triangles.
class NodalSurface : public SurfaceNodes {
public:
  NodalSurface() = default;
  /// At rest; places in m, faces by numbers of nodes.
  NodalSurface(std::vector<Vector3> places, std::vector<std::array<Index, 3>> faces);

  bool exists() const { return !faces_.empty(); }
  std::size_t face_count() const { return faces_.size(); }
  geometry::Triangle corners(std::size_t face, Real time) const;
  FacePoint point(std::size_t face, Real time, const Vector3& place) const;
  /// Its faces as they count in contacts; nodes are vertices. What they count follows from where the nodes are at rest.
  FacetComplex complex() const;

private:
  std::vector<std::array<Index, 3>> faces_;
};

}  // namespace sazare::geometry
