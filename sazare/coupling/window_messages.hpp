#pragma once

/// What the two sides of a coupling tell each other: finite elements (or any other solver of a continuum) on one, bodies of a
/// discrete method on the other, which feel the surface between them as a moving wall.
///
/// The run is cut into windows of equal length. For every window the continuum says where the surface's nodes are at the window's
/// end; the bodies go through the window, between the last motion and this one, and answer with the forces that they have put on
/// the nodes. A motion of the same window with a higher pass takes the bodies back to the window's beginning; one of the next
/// window accepts it. Before the first window the bodies answer the shape with the forces at the beginning, as of window -1.
///
/// Between the ends of a window nodes move with a constant velocity, so that the place of a touching point and its velocity
/// agree, and the work of the surface on the bodies is that of the bodies on the surface, with the sign changed.

#include <cstdint>
#include <vector>

#include "sazare/core/vector.hpp"

namespace sazare::coupling {

/// Told once, by the continuum, at the beginning.
struct SurfaceShape {
  int dimension = 3;        ///< of the continuum, 2 (plane strain) or 3
  Real width = 1;           ///< of the slab of bodies along the third axis, of which the plane's forces are a mean [m]; 1 in 3-D
  Real window = 0;          ///< length [s]
  std::vector<Real> nodes;  ///< places at the beginning, `dimension` numbers each [m]
  std::vector<std::int32_t> faces;  ///< numbers of nodes, `dimension` each: segments in 2-D, triangles in 3-D; bodies are to the
                                    ///< left of a segment, and on the side from which a triangle turns counterclockwise
};

/// From the continuum: the nodes at the end of a window, `dimension` numbers each.
struct SurfaceMotion {
  std::int64_t window = 0;         ///< from 0
  std::int32_t pass = 0;           ///< from 0
  Real time = 0;                   ///< of the window's end [s]
  std::vector<Real> displacement;  ///< since the beginning [m]
  std::vector<Real> velocity;      ///< of the continuum at that time, for who wants a smoother path [m/s]
};

/// From the bodies: what the surface got from them in a window, `dimension` numbers a node.
struct SurfaceForce {
  std::int64_t window = 0;  ///< -1 at the beginning
  std::int32_t pass = 0;
  Real time = 0;           ///< of the window's end [s]
  std::vector<Real> mean;  ///< impulse over the window by its length [N], in 2-D [N/m]
  std::vector<Real> last;  ///< at the window's end [N], in 2-D [N/m]
};

}  // namespace sazare::coupling
