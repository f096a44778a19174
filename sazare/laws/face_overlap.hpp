#pragma once

/// Contact of the true faces of blocks: a pressure that grows with the depth of the overlap, a dashpot, and friction.
///
///     E = k W                  W    overlap of two blocks, weighted with its depth (geometry/tetrahedron_overlap.hpp) [m4]
///     F = -k dW/du             k    face_stiffness [Pa/m]: two faces of area A that overlap by d push with k A d
///     D against v_n, T against v_t, as of two spheres (laws/sphere_contact.hpp) with the spring K = k A and the dashpot c A
///
/// c is face_damping [Pa s/m], A the area across the normal. F is the slope of an energy, whatever the blocks do: no sliding over
/// edges, corners or the seams between blocks makes or takes any.

#include "sazare/laws/sphere_contact.hpp"

namespace sazare::laws {

struct FaceOverlap {
  Real stiffness = 0;  ///< k [Pa/m]
  Real damping = 0;    ///< c [Pa s/m]
  Real friction = 0;   ///< [-]
  DampingCap cap = DampingCap::step;

  /// The law of two spheres that are as stiff as faces of an area [m2].
  SphereContact over(Real area) const { return {stiffness * area, damping * area, friction, cap}; }
};

}  // namespace sazare::laws
