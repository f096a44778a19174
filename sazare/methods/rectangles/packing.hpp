#pragma once

/// Irregular packings of convex polygons: the cells of nuclei, joined along their common sides.

#include <span>
#include <vector>

#include "sazare/geometry/plane/outline_contact.hpp"
#include "sazare/methods/rectangles/face_links.hpp"

namespace sazare::methods::rectangles {

/// An element's centre is the centroid of its cell, since it turns about that; how long a spring is, the nuclei say. With equal
/// stiffnesses along and across, elements that move as their nuclei in a uniform strain are in equilibrium, with the stress of
/// an elastic body of Poisson's ratio 0. Bolander and Saito (1998), *Fracture analyses using spring networks with random
/// geometry*, section 2.
struct Packing {
  std::vector<geometry::Vector2> centres;               ///< centroids [m]
  std::vector<std::vector<geometry::Vector2>> corners;  ///< of an element, from its centre [m]
  std::vector<geometry::Faces> outside;                 ///< faces of an element on the outline
  std::vector<FacetLink> facets;                        ///< of kind 0; elements count from 0
};

/// Cuts a convex outline into the cells of nuclei; `area_density` is the mass over area [kg/m2].
Packing pack(std::span<const geometry::Vector2> nuclei, std::span<const geometry::Vector2> outline, Real area_density);

/// Stiffnesses [Pa] along and across of facets that have any direction with equal chance, from Young's modulus [Pa] and Poisson's
/// ratio in plane strain:
///
///     k_n = 2 (lambda + mu),   k_s = 2 (mu - lambda)        lambda, mu   Lame's constants [Pa]
///
/// If every element moves as its nucleus does in a uniform strain e, the energy over the area is the mean of (k_n (n.e n)^2 +
/// k_s (s.e n)^2) over all directions, since the facets' lengths times distances add up to twice the area. With k_s < k_n
/// elements move a little beside that, so a packing is somewhat softer. Poisson's ratio is 1/4 at most, where k_s is 0.
struct FacetStiffness {
  Real normal = 0, shear = 0;
};
FacetStiffness facet_stiffness(Real youngs_modulus, Real poisson_ratio);

}  // namespace sazare::methods::rectangles
