#pragma once

/// Springs between rigid tetrahedra that together stand for an elastic body.
///
///     k_n = K_n/H,  k_s = K_s/H                 H    distance of the centres of two elements, normal to their face [m]
///     K_n = E/((1 - 2 nu)(1 + a (1 - 2 nu)))    E    Young's modulus [Pa]
///     K_s = K_n (1 - 2 nu)/(1 + b nu + c nu^2)  nu   Poisson's ratio
///
/// A uniform compression changes every distance alike and makes nothing slide but what lies askew: without the term in a, 3 times
/// the bulk modulus is K_n. The rest cannot be derived, since elements in a packing find their own places and turns. a, b and c
/// are fitted to the stiffness of irregular meshes, at rest and without the engine, by tools/fit_block_elasticity.py.
///
/// With nu, the springs along the faces weaken, down to none at 0.5, where nothing holds the elements in shear.

#include <cmath>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

/// Stress per strain between the centres of two elements [Pa].
struct SpringModuli {
  Real normal = 0;  ///< K_n
  Real shear = 0;   ///< K_s
};

struct ElasticModuli {
  Real young = 0;    ///< E [Pa]
  Real poisson = 0;  ///< nu

  Real shear() const { return young / (2 * (1 + poisson)); }                                     ///< [Pa]
  Real bulk() const { return young / (3 * (1 - 2 * poisson)); }                                  ///< [Pa]
  Real confined() const { return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)); }  ///< of a plane P wave [Pa]
};

/// Poisson's ratios beyond this one were not fitted: E there is less than a tenth of K_n, so steps would be very small.
inline constexpr Real most_poisson_ratio = 0.45;

/// Whether the fit holds for a ratio K_s/K_n.
inline bool is_fitted(Real ratio) { return ratio >= 0.03 && ratio <= 1; }

namespace block_elasticity {

inline constexpr Real a = 0.0519, b = 3.027, c = 2.386;

}  // namespace block_elasticity

inline SpringModuli spring_moduli(const ElasticModuli& body) {
  using namespace block_elasticity;
  const Real nu = body.poisson, softness = 1 - 2 * nu, normal = body.young / (softness * (1 + a * softness));
  return {normal, normal * softness / (1 + b * nu + c * nu * nu)};
}

/// The body for which springs stand; the same fit, read the other way round.
inline ElasticModuli elastic_moduli(const SpringModuli& springs) {
  using namespace block_elasticity;
  const Real ratio = springs.shear / springs.normal, half = 1 + b * ratio / 2;
  const Real nu = (1 - ratio) / (half + std::sqrt(half * half + c * ratio * (1 - ratio))), softness = 1 - 2 * nu;
  return {springs.normal * softness * (1 + a * softness), nu};
}

}  // namespace sazare::laws
