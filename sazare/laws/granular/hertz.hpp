#pragma once

/// Spheres that are pressed together elastically.
///
///     N = K a d     U = 2/5 N d     a = sqrt(R d)
///     K = 4/3 E     G = 8 G_     C = 2 sqrt(5/6) b sqrt(3/2 K)     D = 2 sqrt(5/6) b sqrt(G)     b = -ln e/sqrt(pi^2 + ln^2 e)
///
/// d    overlap [m]                                        a    radius of the contact [m]
/// R    reduced radius [m]                                 U    energy of the normal spring [J]
/// E    1/E = sum (1 - nu^2)/E_i [Pa]                      G_   1/G_ = sum (2 - nu)/G_i [Pa]
/// e    coefficient of restitution [-]
///
/// [Hertz1881]; [Mindlin1953] without slip at the edge of the contact, see mindlin_deresiewicz.hpp for that; dashpots [Tsuji1992] with the damping that gives the
/// restitution e exactly and at any speed [Antypov2011], eq. (17): sqrt(5) b sqrt(K m) R^(1/4) d^(1/4) v_n. For that N may pull
/// at the very end of a contact; friction never sees a negative N.

#include <algorithm>
#include <array>

#include "sazare/laws/granular/contact_constants.hpp"

namespace sazare::laws {

inline ContactConstants<Real> hertz_constants(const GrainElasticity& one, const GrainElasticity& other, Real restitution,
                                              const GrainFriction& friction) {
  const auto softness = [](const GrainElasticity& of) { return (1 - of.poisson_ratio * of.poisson_ratio) / of.youngs_modulus; };
  const auto shear_softness = [](const GrainElasticity& of) {
    return (2 - of.poisson_ratio) * 2 * (1 + of.poisson_ratio) / of.youngs_modulus;
  };
  ContactConstants<Real> constants;
  constants.normal = 4.0 / 3.0 / (softness(one) + softness(other));
  constants.tangential = 8 / (shear_softness(one) + shear_softness(other));
  const Real damping = 2 * std::sqrt(5.0 / 6.0) * damping_share(restitution);
  constants.normal_damping = damping * std::sqrt(1.5 * constants.normal);
  constants.tangential_damping = damping * std::sqrt(constants.tangential);
  constants.friction = friction.sliding;
  constants.rolling = friction.rolling;
  constants.twisting = friction.twisting;
  return constants;
}

struct Hertz {
  static constexpr std::string_view word = "hertz";
  static constexpr bool needs_elasticity = true, adheres = false, slips_in_part = false;
  static constexpr Real steepness = 1.5;  ///< dN/dd over K a, at most
  static constexpr std::array<LawParameter, 0> parameters{};

  static ContactConstants<Real> constants(const MaterialsInContact& of, const std::array<Real, 0>&) {
    return hertz_constants(of.one, of.other, of.restitution, of.friction);
  }

  template <class Number>
  static Number width(const ContactConstants<Number>&, const Number& overlap, const Reduced<Number>& radius) {
    return root_of_quotient(Number(radius.product * overlap), radius.sum);
  }
  template <class Number>
  static Number force(const ContactConstants<Number>& constants, const Number& width, const Number& overlap,
                      const Reduced<Number>&) {
    return constants.normal * width * overlap;
  }
  /// `force` is that of the spring.
  template <class Number>
  static Number energy(const ContactConstants<Number>&, const Number& force, const Number&, const Number& overlap,
                       const Reduced<Number>&) {
    return 0.4 * force * overlap;
  }
  /// The load on which the limits of friction and rolling hang.
  template <class Number>
  static Number pressing(const ContactConstants<Number>&, const Number& normal, const Reduced<Number>&) {
    return maximum(normal, Number{});
  }

  static Real stored_energy(const ContactConstants<Real>& constants, Real overlap, Real reduced_radius) {
    return 0.4 * constants.normal * std::sqrt(reduced_radius * overlap) * overlap * overlap;
  }
  static Real overlap_of_energy(const ContactConstants<Real>& constants, Real energy, Real reduced_radius) {
    return std::pow(energy / (0.4 * constants.normal * std::sqrt(reduced_radius)), 0.4);
  }

  /// Rayleigh time step: in it a surface wave goes half around the sphere. One of a bonded body has less mass than one that
  /// stands alone, so its contacts last less long [s].
  static Real stable_step(const GrainInPack& grain) {
    const Real ratio = grain.elasticity.poisson_ratio, shear_modulus = 0.5 * grain.elasticity.youngs_modulus / (1 + ratio);
    const Real alone = std::numbers::pi * grain.radius * std::sqrt(grain.density / shear_modulus) / (0.1631 * ratio + 0.8766);
    return alone * std::sqrt(std::min(grain.mass_share, Real{1}));
  }
};

}  // namespace sazare::laws
