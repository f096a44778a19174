#pragma once

/// What laws of granular contact have in common: the constants that they run on, and what these are made from.

#include <cmath>
#include <numbers>
#include <span>

#include "sazare/core/vector_of.hpp"
#include "sazare/laws/law_list.hpp"

namespace sazare::laws {

/// Constants of two materials in contact; single numbers stand as eight doubles, which lanes read at once.
template <class Number>
struct alignas(sizeof(Number) == sizeof(Real) ? 64 : alignof(Number)) ContactConstants {
  Number normal{};              ///< K [Pa], linear [N/m]
  Number tangential{};          ///< G [Pa], linear [N/m]
  Number normal_damping{};      ///< C [sqrt(Pa)]
  Number tangential_damping{};  ///< D [sqrt(Pa)]
  Number friction{};            ///< mu [-]
  Number rolling{};             ///< mu_r [-]
  Number twisting{};            ///< mu_t [-]
  Number adhesion{};            ///< w [J/m2], 0 where the law does not adhere
};

/// b of a coefficient of restitution, 0 < e <= 1.
inline Real damping_share(Real restitution) {
  const Real log = std::log(restitution);
  return -log / std::sqrt(std::numbers::pi * std::numbers::pi + log * log);
}

/// Coefficients of the sliders: largest force, and largest moments over the reduced radius, over the normal force.
struct GrainFriction {
  Real sliding = 0;   ///< mu [-]
  Real rolling = 0;   ///< mu_r [-]
  Real twisting = 0;  ///< mu_t, about the normal [-]
};

struct GrainElasticity {
  Real youngs_modulus = 0;  ///< [Pa]
  Real poisson_ratio = 0;   ///< [-]
};

/// Two materials in contact: what every law may make its constants from, beside its own parameters.
struct MaterialsInContact {
  GrainElasticity one, other;
  Real restitution = 1;
  GrainFriction friction;
};

/// A sphere among others of its material, for which the longest stable step is sought.
struct GrainInPack {
  GrainElasticity elasticity;
  Real density = 0;     ///< [kg/m3]
  Real radius = 0;      ///< [m]
  Real mass = 0;        ///< [kg]
  Real mass_share = 1;  ///< its mass over that of a full sphere; 1 where it stands alone
  std::span<const ContactConstants<Real>> contacts;  ///< of its material with every one
};

/// a b / (a + b) of two numbers, or a of one that has no partner. Its roots need no division.
template <class Number>
struct Reduced {
  Number product, sum;

  static Reduced of(const Number& a, const Number& b) { return {a * b, a + b}; }
  static Reduced alone(const Number& a) { return {a, Number{} + 1}; }

  Number value() const { return product / sum; }
};

}  // namespace sazare::laws
