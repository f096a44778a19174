#pragma once

/// Mohr-Coulomb strength of ground with a tension cut-off; perfectly plastic.
///
///     f_s = (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) <= 0       shear
///     f_t = s1 - s_t <= 0                                            tension
///     de_p = dg (1 + sin(psi), 0, -(1 - sin(psi)))  and  dg (1, 0, 0)    flow
///
///     s1 >= s3  largest and smallest principal stress [Pa], tension positive     c    cohesion [Pa]
///     phi       angle of friction                                                s_t  tensile strength [Pa]
///     psi       angle of dilation                                                e_p  plastic strain [-]
///
/// In plane strain the principal stresses of the plane count: the one across it is taken to lie between them, as it does for
/// ground that yields in shear. de Souza Neto, Peric and Owen, Computational Methods for Plasticity (2008), section 8.2.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

struct MohrCoulomb {
  Real cohesion = 0;          ///< c [Pa]
  Real tan_friction = 0;      ///< of phi [-]
  Real sin_friction = 0;      ///< of phi [-]
  Real cos_friction = 1;      ///< of phi [-]
  Real sin_dilation = 0;      ///< of psi [-]
  Real tensile_strength = 0;  ///< s_t [Pa]

  /// Angles in radians. Without a tensile strength, tension is limited by the tip of the shear strength alone, c / tan(phi).
  static MohrCoulomb make(Real cohesion, Real friction_angle, Real dilation_angle, std::optional<Real> tensile_strength) {
    const Real tip = friction_angle > 0 ? cohesion / std::tan(friction_angle) : std::numeric_limits<Real>::infinity();
    return {cohesion,
            std::tan(friction_angle),
            std::sin(friction_angle),
            std::cos(friction_angle),
            std::sin(dilation_angle),
            std::min(tensile_strength.value_or(tip), tip)};
  }

  Real shear(Real largest, Real smallest) const {
    return (largest - smallest) + (largest + smallest) * sin_friction - 2 * cohesion * cos_friction;
  }
  Real tension(Real largest) const { return largest - tensile_strength; }
  /// Of a plane under a normal stress, of compression, in ground that flows coaxially in plane strain (Davis 1968) [Pa].
  Real shear_strength(Real normal_stress) const {
    const Real cos_dilation = std::sqrt(1 - sin_dilation * sin_dilation);
    return (cohesion * cos_friction + normal_stress * sin_friction) * cos_dilation / (1 - sin_friction * sin_dilation);
  }
  bool bears(Real largest, Real smallest) const { return shear(largest, smallest) <= 0 && tension(largest) <= 0; }
};

/// Isotropic elasticity.
struct Elasticity {
  Real shear_modulus = 0;  ///< mu [Pa]
  Real lame = 0;           ///< lambda [Pa]

  template <std::size_t D>
  std::array<Real, D> stress(const std::array<Real, D>& strain) const {
    Real volume = 0;
    for (const Real part : strain) volume += part;
    std::array<Real, D> result;
    for (std::size_t i = 0; i < D; ++i) result[i] = 2 * shear_modulus * strain[i] + lame * volume;
    return result;
  }
};

template <std::size_t D>
struct PlasticFlow {
  std::array<Real, D> strain{};  ///< increment of e_p by principal direction [-]
  Real slip = 0;                 ///< largest difference of its parts, or the largest opening [-]
};

/// What flows when an elastic strain, given by its principal parts, is brought back to the strength. Each ordered pair of
/// directions has a plane f_s = 0, each direction one f_t = 0; their amounts dg >= 0 are found by projected Gauss-Seidel sweeps.
template <std::size_t D>
PlasticFlow<D> plastic_flow(const MohrCoulomb& law, const Elasticity& elastic, const std::array<Real, D>& strain) {
  constexpr int most_sweeps = 5000;
  const Real mu = elastic.shear_modulus, lambda = elastic.lame;
  const Real tension = std::isfinite(law.tensile_strength) ? law.tensile_strength : 0;
  const Real tolerance = 1e-9 * (law.cohesion + tension + 1e-6 * mu);
  const Real opening = 1 + law.sin_dilation, closing = 1 - law.sin_dilation, growth = lambda * (opening - closing);
  const Real shear_relief =
      (1 + law.sin_friction) * (2 * mu * opening + growth) + (1 - law.sin_friction) * (2 * mu * closing - growth);
  std::array<std::array<Real, D>, D> amount{};  // dg: of the pair (i, k), and on the diagonal of tension along i
  std::array<Real, D> stress = elastic.stress(strain);
  const auto flow_along = [&](std::size_t i, Real part) {
    for (std::size_t k = 0; k < D; ++k) stress[k] -= (i == k ? 2 * mu + lambda : lambda) * part;
  };
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    Real worst = 0;
    for (std::size_t i = 0; i < D; ++i)
      for (std::size_t k = 0; k < D; ++k) {
        const Real excess = i == k ? law.tension(stress[i]) : law.shear(stress[i], stress[k]);
        const Real more = std::max(excess / (i == k ? 2 * mu + lambda : shear_relief), -amount[i][k]);
        if (more == 0) continue;
        worst = std::max(worst, std::abs(excess));
        amount[i][k] += more;
        flow_along(i, i == k ? more : opening * more);
        if (i != k) flow_along(k, -closing * more);
      }
    if (worst <= tolerance) break;
  }
  PlasticFlow<D> flow;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k) {
      flow.strain[i] += (i == k ? 1 : opening) * amount[i][k];
      if (i != k) flow.strain[k] -= closing * amount[i][k];
    }
  const auto [least, most] = std::minmax_element(flow.strain.begin(), flow.strain.end());
  flow.slip = std::max(*most, Real{0}) - std::min(*least, Real{0});
  return flow;
}

}  // namespace sazare::laws
