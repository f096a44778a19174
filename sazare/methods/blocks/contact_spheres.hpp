#pragma once

/// The contact spheres of a free face: inside the block, tangent to the face at the interior points of an equal
/// subdivision of its edges.
///
///     r = min_k d_k / (1 - n . n_k)      n    outward normal of the face, n_k those of the three other faces
///                                        d_k  distance of the point from face k [m]
///
/// so that no sphere leaves its block through another face. [Konno2018], 2.2 and fig. 5.

#include <vector>

#include "sazare/geometry/tetrahedron.hpp"

namespace sazare::methods::blocks {

struct ContactSphere {
  Vector3 centre;   ///< in the frame of the corners given [m]
  Real radius = 0;  ///< [m]
};

/// Spheres of one local face, (n - 1)(n - 2)/2 for a division of each edge into n >= 3.
std::vector<ContactSphere> contact_spheres(const geometry::Tetrahedron& corners, int face, int edge_division);

/// A sphere around them.
ContactSphere bounding_sphere(const std::vector<ContactSphere>& spheres);

}  // namespace sazare::methods::blocks
