#pragma once

/// Cohesion that falls with plastic shear from a peak to a residual value.
///
///     c   = c_p - (c_p - c_r) min(k/k_r, 1)       s_t = s_tp c/c_p
///
///     c, c_p, c_r  cohesion now, at the peak, residual [Pa]       k    plastic shear strain so far, `slip` of laws/mohr_coulomb.hpp [-]
///     s_t, s_tp    tensile strength now and at the peak [Pa]      k_r  softening strain, at which c_r is reached [-]
///
/// Angles of friction and dilation stay. A strain step is brought back to the strength that is left after it (implicit). A law
/// that softens has no width of its own for the band to which strain goes: k_r must follow from whoever resolves it, such as
/// methods/mps/softening.hpp.

#include "sazare/laws/mohr_coulomb.hpp"

namespace sazare::laws {

struct CohesionSoftening {
  Real residual_cohesion = 0;  ///< c_r [Pa]
  Real strain = 0;             ///< k_r [-]; 0: perfectly plastic

  bool softens() const { return strain > 0; }

  /// The strength after a plastic shear strain.
  MohrCoulomb at(const MohrCoulomb& peak, Real slip) const {
    if (!softens()) return peak;
    MohrCoulomb law = peak;
    law.cohesion -= (peak.cohesion - residual_cohesion) * std::min(slip / strain, Real{1});
    if (std::isfinite(peak.tensile_strength)) law.tensile_strength *= law.cohesion / peak.cohesion;
    return law;
  }
};

/// As plastic_flow, of ground that has a plastic shear strain `slip` behind it. Its size is found by iteration, which contracts
/// where softening is slower than unloading: (c_p - c_r)/k_r well below mu.
template <std::size_t D>
PlasticFlow<D> softening_flow(const MohrCoulomb& peak, const CohesionSoftening& softening, const Elasticity& elastic, Real slip,
                              const std::array<Real, D>& strain) {
  constexpr int most_rounds = 60;
  constexpr Real same = 1e-9;  // of the slip
  auto flow = plastic_flow<D>(softening.at(peak, slip), elastic, strain);
  for (int round = 0; softening.softens() && round < most_rounds; ++round) {
    const Real before = flow.slip;
    flow = plastic_flow<D>(softening.at(peak, slip + before), elastic, strain);
    if (std::abs(flow.slip - before) <= same * flow.slip) break;
  }
  return flow;
}

}  // namespace sazare::laws
