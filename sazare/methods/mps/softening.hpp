#pragma once

/// How fast the cohesion of particles must fall with strain, that it falls over a given slip across a band.
///
/// A particle yields by its own plastic strain, its links relax to the mean of both ends (ground_strength.hpp). Where the plastic
/// shear strain k varies, the stress that a particle sees is more than what its links carry, as in gradient plasticity:
///
///     s = c(k) - (M mu/4) laplacian(k),       M = a sum(w r^4)/sum(w r^2),   a = 3/4 in the plane, 3/5 in space
///
/// So softening ground has an inner length, and strain goes to a band of finite width:
///
///     k = (1 - t) k_r (1 + cos(y/L)),   |y| <= pi L = b/2,   L = sqrt(M mu k_r/(4 d))
///
/// until its middle reaches k_r at t = 1/2. Its slip, the integral of k, is (1 - t) u with u = 2 pi L k_r, so the stress falls with
/// slip in a line that would reach the residual strength at u. Given u,
///
///     k_r = (u^2 d/(pi^2 M mu))^(1/3)
///
/// Then stress against slip is one curve whatever the spacing. From t = 1/2 on the middle of the band, where nothing softens any
/// more, becomes wider with slip, and the stress falls more slowly than in that line:
///
///     slip/u = [(1 - t) acos(-t/(1 - t)) - sqrt(1 - 2 t) + a + t a^3/3]/pi,     a = sqrt(1 - 2 t)/t
///
/// M is a mean over the directions of a band: in the plane, with links to 1.5 spacings, its slip is 10 % more along an axis of the
/// lattice and 11 % less along its diagonals.
///
///     s    shear stress in the band [Pa]       t   what is left of the drop, 1 at the peak [-]   u  softening displacement [m]
///     d    drop of shear strength [Pa]         mu  shear modulus [Pa]                            b  width of the band [m]
///     k_r  softening strain [-]                w   stiffness of links of length r (laws/particle_link.hpp)
///
/// d is (c_p - c_r) cos(phi) cos(psi)/(1 - sin(phi) sin(psi)), which coaxial flow bears on a plane (Davis 1968).
///
/// Width of a band of gradient plasticity: de Borst and Muhlhaus, Int. J. Num. Meth. Eng. 35 (1992) 521-539. A softening strain that
/// follows from the size of what resolves the band, so that the energy of the band does not depend on it: Bazant and Oh,
/// Materials and Structures 16 (1983) 155-177; there the band is as wide as an element, which here it is not.

#include <cmath>
#include <numbers>

#include "sazare/laws/cohesion_softening.hpp"
#include "sazare/methods/mps/link_table.hpp"

namespace sazare::methods::mps {

/// What the softening of a ground is made of.
struct SofteningBand {
  Real drop = 0;             ///< d [Pa]
  Real shear_modulus = 0;    ///< mu [Pa]
  Real displacement = 0;     ///< u [m]
  Real square_of_reach = 0;  ///< M [m2]

  /// k_r [-].
  Real strain() const {
    const Real slope = displacement / std::numbers::pi;
    return std::cbrt(slope * slope * drop / (square_of_reach * shear_modulus));
  }
  /// b [m].
  Real width() const { return displacement / strain(); }
  /// The spacing at which the band is 2 pi spacings wide, M being that of another one [m]. Particles do not resolve a narrower band:
  /// the stress falls in less and less slip, and snaps back.
  Real largest_spacing(Real spacing) const {
    const Real share = square_of_reach / (spacing * spacing);
    return displacement * shear_modulus * share / (8 * std::numbers::pi * drop);
  }
};

inline Real drop_of_strength(const laws::MohrCoulomb& peak, Real residual_cohesion) {
  const Real cos_dilation = std::sqrt(1 - peak.sin_dilation * peak.sin_dilation);
  return (peak.cohesion - residual_cohesion) * peak.cos_friction * cos_dilation / (1 - peak.sin_friction * peak.sin_dilation);
}

/// M of the links of a whole neighbourhood [m2].
template <int D>
Real square_of_reach(const LinkTable<D>& links) {
  Real fourth = 0, second = 0;
  for (const auto& direction : links.directions) {
    const Real square = direction.law.start.squaredNorm();
    fourth += direction.law.spring * square * square;
    second += direction.law.spring * square;
  }
  constexpr Real share = D == 2 ? 0.75 : 0.6;
  return share * fourth / second;
}

}  // namespace sazare::methods::mps
