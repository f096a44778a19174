#pragma once

/// The surface of a continuum as bodies in space see it. One in the plane becomes one in space: each segment a rectangle across
/// the slab of bodies, whose forces are divided by the slab's width; what pushes across the plane, the plane strain holds.

#include <array>

#include "sazare/core/time.hpp"
#include "sazare/coupling/window_messages.hpp"

namespace sazare::methods::hybrid {

class SlabSurface {
public:
  SlabSurface() = default;
  /// `low` and `high`: of the rectangles along z, in the plane [m].
  SlabSurface(const coupling::SurfaceShape& shape, Real low, Real high) : shape_(shape), low_(low), high_(high) {}

  /// The same surface elsewhere.
  void move_to(const coupling::SurfaceShape& shape) { shape_ = shape; }

  /// Positions of the nodes in 3-D; of a 2-D continuum first those at the lower end of the slab, then those at the other [m].
  std::vector<Vector3> places(const std::vector<Real>& displacement) const;
  std::vector<std::array<Index, 3>> triangles() const;
  /// Forces times a factor, for the nodes of the continuum: in the plane the sum across the slab, by its width.
  std::vector<Real> folded(const std::vector<Vector3>& forces, Real factor) const;

private:
  bool is_plane() const { return shape_.dimension == 2; }

  coupling::SurfaceShape shape_;
  Real low_ = 0, high_ = 0;
};

}  // namespace sazare::methods::hybrid
