#pragma once

/// How fast the strength of particles must fall with strain, that it falls over a given slip across a band.
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
/// until its middle reaches k_r at t = 1/2. Its slip, the integral of k, is (1 - t) u with u = 2 pi L k_r, so the stress falls
/// with slip in a line that would reach the residual strength at u. Given u,
///
///     k_r = (u^2 d/(pi^2 M mu))^(1/3)
///
/// Then stress against slip is one curve whatever the spacing. From t = 1/2 on the middle of the band, where nothing softens any
/// more, becomes wider with slip, and the stress falls more slowly than in that line:
///
///     slip/u = [(1 - t) acos(-t/(1 - t)) - sqrt(1 - 2 t) + a + t a^3/3]/pi,     a = sqrt(1 - 2 t)/t
///
/// M is a mean over the directions of a band: in the plane, with links to 1.5 spacings, its slip is 10 % more along an axis of
/// the lattice and 11 % less along its diagonals.
///
///     s    shear stress in the band [Pa]       t   what is left of the drop, 1 at the peak [-]   u  softening displacement [m]
///     d    drop of shear strength [Pa]         mu  shear modulus [Pa]                            b  width of the band [m]
///     k_r  softening strain [-]                w   stiffness of links of length r (laws/particle_link.hpp)
///
/// d is the difference of (c cos(phi) + s_n sin(phi)) cos(psi)/(1 - sin(phi) sin(psi)) at the peak and at the residual strength,
/// which coaxial flow bears on a plane with the normal stress s_n (Davis 1968). Where friction falls it goes by the stress that a
/// particle has when it flows, so that u is the same at any depth. No band is wider than the ground is high, H: k_r is u/H at
/// least. Nor is it narrower than 2 pi spacings D, which particles do not resolve: k_r is 4 d D^2/(M mu) at least, and where that
/// is more than what u asks for the slip is larger than u.
///
/// Width of a band of gradient plasticity: de Borst and Muhlhaus, Int. J. Num. Meth. Eng. 35 (1992) 521-539. A softening strain
/// that follows from the size of what resolves the band, so that the energy of the band does not depend on it: Bazant and Oh,
/// Materials and Structures 16 (1983) 155-177; there the band is as wide as an element, which here it is not.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sazare/laws/strength_softening.hpp"
#include "sazare/methods/mps/link_table.hpp"

namespace sazare::methods::mps {

/// What the softening of a ground is made of.
struct SofteningBand {
  Real drop = 0;             ///< d [Pa]
  Real shear_modulus = 0;    ///< mu [Pa]
  Real displacement = 0;     ///< u [m]
  Real square_of_reach = 0;  ///< M [m2]
  Real spacing = 0;          ///< D [m]
  Real height = std::numeric_limits<Real>::infinity();  ///< H [m]

  /// k_r [-].
  Real strain() const {
    const Real slope = displacement / std::numbers::pi;
    return std::max({std::cbrt(slope * slope * drop / (square_of_reach * shear_modulus)), displacement / height,
                     4 * drop * spacing * spacing / (square_of_reach * shear_modulus)});
  }
  /// b [m].
  Real width() const { return std::min(std::numbers::pi * std::sqrt(square_of_reach * shear_modulus * strain() / drop), height); }
  /// The spacing at which a band whose slip is u is 2 pi spacings wide [m].
  Real largest_spacing() const {
    const Real share = square_of_reach / (spacing * spacing);
    return displacement * shear_modulus * share / (8 * std::numbers::pi * drop);
  }
};

/// The softening of a ground among particles.
struct Softening {
  laws::StrengthSoftening law;
  SofteningBand band;  ///< its drop is none of its own: it follows the stress

  /// The band under a normal stress, of compression [Pa].
  SofteningBand under(const laws::MohrCoulomb& peak, Real normal_stress) const {
    SofteningBand at_stress = band;
    at_stress.drop = std::max(law.drop(peak, std::max(normal_stress, Real{0})), Real{0});
    return at_stress;
  }
  /// k_r of ground whose strength now is `present` and whose larger and smaller principal stress have this mean, positive in
  /// compression [-].
  Real strain(const laws::MohrCoulomb& peak, const laws::MohrCoulomb& present, Real mean_stress) const {
    const Real radius = present.cohesion * present.cos_friction + mean_stress * present.sin_friction;
    return under(peak, mean_stress - radius * present.sin_dilation).strain();
  }
};

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
