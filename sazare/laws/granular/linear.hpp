#pragma once

/// Linear springs.
///
///     N = K d     U = 1/2 N d     a = 1     C = 2 b sqrt(K)     D = 2 b sqrt(G)     b = -ln e/sqrt(pi^2 + ln^2 e)
///
/// d    overlap [m]                                        K, G springs along the normal and across it [N/m]
/// U    energy of the normal spring [J]                    e    coefficient of restitution [-]
///
/// A contact lasts pi/sqrt(K/m (1 - b^2)).

#include <algorithm>
#include <array>

#include "sazare/laws/granular/contact_constants.hpp"

namespace sazare::laws {

inline ContactConstants<Real> linear_constants(Real normal_stiffness, Real shear_stiffness, Real restitution,
                                               const GrainFriction& friction) {
  const Real damping = 2 * damping_share(restitution);
  return {normal_stiffness,
          shear_stiffness,
          damping * std::sqrt(normal_stiffness),
          damping * std::sqrt(shear_stiffness),
          friction.sliding,
          friction.rolling,
          friction.twisting};
}

struct Linear {
  static constexpr std::string_view word = "linear";
  static constexpr bool needs_elasticity = false, adheres = false, slips_in_part = false;
  static constexpr Real steepness = 1;
  static constexpr std::string_view required = "required for model linear, here or in every pair";
  static constexpr std::array parameters{
      LawParameter{.name = "contact_stiffness",
                   .unit = "N/m",
                   .note = required,
                   .sentence = "Normal stiffness: normal force per overlap."},
      LawParameter{.name = "contact_shear_stiffness",
                   .unit = "N/m",
                   .note = required,
                   .sentence = "Shear stiffness: tangential force per tangential displacement."}};

  static ContactConstants<Real> constants(const MaterialsInContact& of, const std::array<Real, 2>& stiffness) {
    return linear_constants(stiffness[0], stiffness[1], of.restitution, of.friction);
  }

  template <class Number>
  static Number width(const ContactConstants<Number>&, const Number&, const Reduced<Number>&) {
    return Number{} + 1;
  }
  template <class Number>
  static Number force(const ContactConstants<Number>& constants, const Number& width, const Number& overlap,
                      const Reduced<Number>&) {
    return constants.normal * width * overlap;
  }
  template <class Number>
  static Number energy(const ContactConstants<Number>&, const Number& force, const Number&, const Number& overlap,
                       const Reduced<Number>&) {
    return 0.5 * force * overlap;
  }
  template <class Number>
  static Number pressing(const ContactConstants<Number>&, const Number& normal, const Reduced<Number>&) {
    return maximum(normal, Number{});
  }

  static Real stored_energy(const ContactConstants<Real>& constants, Real overlap, Real) {
    return 0.5 * constants.normal * overlap * overlap;
  }
  static Real overlap_of_energy(const ContactConstants<Real>& constants, Real energy, Real) {
    return std::sqrt(2 * energy / constants.normal);
  }

  /// Twice over the largest frequency of a sphere among twelve like it, as many as can touch it, which all move or turn against
  /// it, on the stiffest springs that its material has [s]:
  ///
  ///     w^2 = 12 2 (k_n/3 + 2/3 k_t)/m  moving        w^2 = 12 2 (2/3 k_t) r^2/(2/5 m r^2)  turning
  static Real stable_step(const GrainInPack& grain) {
    Real stiffest = 0;
    for (const auto& springs : grain.contacts)
      stiffest = std::max({stiffest, 8 * springs.normal + 16 * springs.tangential, 40 * springs.tangential});
    return 2 * std::sqrt(grain.mass / stiffest);
  }
};

}  // namespace sazare::laws
