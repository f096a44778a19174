#pragma once

/// Strength that falls with plastic shear from a peak to a residual value.
///
///     c   = c_p - (c_p - c_r) x                     sin(phi) = sin(phi_p) - (sin(phi_p) - sin(phi_r)) x
///     s_t = s_tp c/c_p                              sin(psi) = sin(psi_p) - (sin(psi_p) - sin(psi_r)) x
///     dx  = dk/k_r,  0 <= x <= 1
///
///     c    cohesion [Pa]              phi  angle of friction     _p   at the peak       k    plastic shear strain, `slip` of
///     s_t  tensile strength [Pa]      psi  angle of dilation     _r   residual               laws/mohr_coulomb.hpp [-]
///     x    share of the fall [-]                                                        k_r  softening strain [-]
///
/// Under a constant mean stress, ground that does not dilate loses its shear strength in a line. The softening strain may follow
/// the stress; what has fallen does not rise again. A strain step is brought back to the strength that is left after it
/// (implicit). A law that softens has no width of its own for the band to which strain goes: k_r must follow from whoever
/// resolves it, such as methods/mps/softening.hpp.

#include "sazare/laws/mohr_coulomb.hpp"

namespace sazare::laws {

struct StrengthSoftening {
  Real residual_cohesion = 0;      ///< c_r [Pa]
  Real residual_sin_friction = 0;  ///< of phi_r [-]
  Real residual_sin_dilation = 0;  ///< of psi_r [-]

  /// The strength after a share of the fall.
  MohrCoulomb at(const MohrCoulomb& peak, Real share) const {
    MohrCoulomb law = peak;
    law.cohesion -= (peak.cohesion - residual_cohesion) * share;
    if (std::isfinite(peak.tensile_strength) && peak.cohesion > 0) law.tensile_strength *= law.cohesion / peak.cohesion;
    law.sin_dilation -= (peak.sin_dilation - residual_sin_dilation) * share;
    if (residual_sin_friction == peak.sin_friction) return law;
    law.sin_friction -= (peak.sin_friction - residual_sin_friction) * share;
    law.cos_friction = std::sqrt(1 - law.sin_friction * law.sin_friction);
    law.tan_friction = law.sin_friction / law.cos_friction;
    return law;
  }
  /// What the shear strength of a plane loses in the whole fall under a constant normal stress, of compression [Pa]. Below 0
  /// where nothing presses and friction falls alone, since c cos(phi) rises then.
  Real drop(const MohrCoulomb& peak, Real normal_stress) const {
    return peak.shear_strength(normal_stress) - at(peak, 1).shear_strength(normal_stress);
  }
};

/// As plastic_flow, of ground whose strength has fallen by a share, with the softening strain that it has now. Its size is found
/// by iteration, which contracts where softening is slower than unloading: the drop of the strength over `softening_strain` well
/// below mu.
template <std::size_t D>
PlasticFlow<D> softening_flow(const MohrCoulomb& peak, const StrengthSoftening& softening, const Elasticity& elastic, Real share,
                              Real softening_strain, const std::array<Real, D>& strain) {
  constexpr int most_rounds = 60;
  constexpr Real same = 1e-9;  // of the slip
  const auto after = [&](Real slip) { return softening.at(peak, std::min(share + slip / softening_strain, Real{1})); };
  auto flow = plastic_flow<D>(after(0), elastic, strain);
  for (int round = 0; round < most_rounds; ++round) {
    const Real before = flow.slip;
    flow = plastic_flow<D>(after(before), elastic, strain);
    if (std::abs(flow.slip - before) <= same * flow.slip) break;
  }
  return flow;
}

}  // namespace sazare::laws
