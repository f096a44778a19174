#pragma once

/// Contact of two spheres, or of a sphere and a wall: an elastic normal force, dashpots from a coefficient of restitution,
/// friction with memory, and resistance to rolling and to twisting.
///
///     N = K a d - C sqrt(a m) v_n        T = slider(G a, D sqrt(a m), mu N)
///     M = R n x slider(G a, D sqrt(a m), mu_r N) + R n slider(G a, D sqrt(a m), mu_t N)
///
/// d    overlap [m]                                        v_n  opening speed [m/s], v_t sliding velocity [m/s]
/// R    reduced radius [m]                                 m    reduced mass [kg]
///
/// Hertz-Mindlin: a = sqrt(R d) is the radius of the contact [m], and with 1/E = sum (1 - nu^2)/E_i, 1/G_ = sum (2 - nu)/G_i
///
///     K = 4/3 E      G = 8 G_      C = 2 sqrt(5/6) b sqrt(3/2 K)      D = 2 sqrt(5/6) b sqrt(G)      b = -ln e/sqrt(pi^2 + ln^2
///     e)
///
/// [Hertz1881]; [Mindlin1953] without the slip history of partial unloading; dashpots [Tsuji1992] with the damping that gives the
/// restitution e exactly and at any speed [Antypov2011], eq. (17): sqrt(5) b sqrt(K m) R^(1/4) d^(1/4) v_n. For that N may pull
/// at the very end of a contact; friction never sees a negative N.
///
/// Linear: a = 1, K and G are springs [N/m], C = 2 b sqrt(K), D = 2 b sqrt(G). A contact lasts pi/sqrt(K/m (1 - b^2)).
///
/// A dashpot is no stronger than a step h bears where a sphere has twelve contacts, as many as equal ones can have: sums of c h/m
/// over them, with spins that go against each other, stay below 1. That is 0.2 m/h along the normal and 0.03 m/h of a slider;
/// contacts that last for more than some 10 steps have weaker dashpots along the normal anyway.
///
/// The slider's memory turns with the contact: its part along n is taken off, which shortens it by 1 - cos of the step's turn.

#include <cmath>
#include <numbers>

#include "sazare/laws/slider.hpp"

namespace sazare::laws {

enum class ContactModel { hertz, linear };

/// Constants of two materials in contact, as lanes read them.
template <class Number>
struct ContactConstants {
  Number normal{};              ///< K [Pa], linear [N/m]
  Number tangential{};          ///< G [Pa], linear [N/m]
  Number normal_damping{};      ///< C [sqrt(Pa)]
  Number tangential_damping{};  ///< D [sqrt(Pa)]
  Number friction{};            ///< mu [-]
  Number rolling{};             ///< mu_r [-]
  Number twisting{};            ///< mu_t [-]
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

/// a b / (a + b) of two numbers, or a of one that has no partner. Its roots need no division.
template <class Number>
struct Reduced {
  Number product, sum;

  static Reduced of(const Number& a, const Number& b) { return {a * b, a + b}; }
  static Reduced alone(const Number& a) { return {a, Number{} + 1}; }

  Number value() const { return product / sum; }
};

/// What the law needs to know of a touching pair.
template <class Number>
struct ContactMotion {
  Number overlap;           ///< d [m], > 0
  Reduced<Number> radius;   ///< R [m]
  Reduced<Number> mass;     ///< m [kg]
  Triple<Number> normal;    ///< n, from the first to the second
  Triple<Number> velocity;  ///< of the second relative to the first where they touch [m/s]
  Triple<Number> rolling;   ///< R (w_2 - w_1) x n [m/s]; read, like the next, where spheres resist to turn on each other
  Number twisting;          ///< R (w_2 - w_1) . n [m/s]
  Number step;              ///< h [s]
};

/// What a pair remembers until it parts.
template <class Number>
struct ContactMemory {
  Triple<Number> sliding;  ///< [m]
  Triple<Number> rolling;  ///< [m]
  Number twisting{};       ///< [m]
};

template <class Number>
struct ContactForce {
  Number normal{};          ///< N on the second, along n [N]
  Triple<Number> friction;  ///< T on the second [N]
  Triple<Number> rolling;   ///< slider's force of rolling [N]; the moment on the second is R n x it
  Number twisting{};        ///< slider's force of twisting [N]; the moment on the second is R n times it
  Number elastic_energy{};  ///< of the normal spring [J]
  Number sliding_energy{};  ///< in the sliders' springs [J]
  Number dashpot_power{};   ///< taken by the normal dashpot [W]
  Number sliding_power{};   ///< work against the sliders: stored and lost [W]
};

/// Energy in the normal spring of a pair at an overlap [J].
inline Real normal_energy(ContactModel model, const ContactConstants<Real>& constants, Real overlap, Real reduced_radius) {
  if (!(overlap > 0)) return 0;
  const Real width = model == ContactModel::hertz ? std::sqrt(reduced_radius * overlap) : 1;
  return (model == ContactModel::hertz ? 0.4 : 0.5) * constants.normal * width * overlap * overlap;
}

/// The overlap at which the normal spring of a pair holds an energy [m].
inline Real overlap_of_energy(ContactModel model, const ContactConstants<Real>& constants, Real energy, Real reduced_radius) {
  if (!(energy > 0)) return 0;
  return model == ContactModel::hertz ? std::pow(energy / (0.4 * constants.normal * std::sqrt(reduced_radius)), 0.4)
                                      : std::sqrt(2 * energy / constants.normal);
}

/// Shares of m/h that dashpots may have at most.
inline constexpr Real most_normal_damping = 0.2, most_tangential_damping = 0.03;

/// Dashpots along the normal and of a slider [N s/m].
template <class Number>
struct Dashpots {
  Number normal, tangential;
};

/// The dashpot `asked`, which is `constant` sqrt(a m), or `share` m/h where that is less; `root` is sqrt(a m).
template <class Number>
Number bearable_damping(const Number& asked, const Number& constant, Real share, const Number& root, const Number& travel) {
  const Number over = constant * travel, bears = share * root;
  return select(over > bears, asked * bears / over, asked);
}

/// Few contacts ask for more than what a step bears: where none does nothing is divided.
template <class Number>
Dashpots<Number> dashpots(const ContactConstants<Number>& constants, const Number& width, const Number& root,
                          const Number& step) {
  const Number normal = constants.normal_damping, tangential = constants.tangential_damping, travel = step * width;
  const Number most =
      maximum(Number((1 / most_normal_damping) * normal), Number((1 / most_tangential_damping) * tangential)) * travel;
  const Dashpots<Number> asked{normal * root, tangential * root};
  if (!any_above(most, root)) return asked;
  // Who asks for less has the same, whoever else is looked at.
  const auto strong = most > root;
  return {
      select(strong, bearable_damping(asked.normal, normal, most_normal_damping, root, travel), asked.normal),
      select(strong, bearable_damping(asked.tangential, tangential, most_tangential_damping, root, travel), asked.tangential)};
}

template <class Number>
Triple<Number> across(const Triple<Number>& vector, const Triple<Number>& normal) {
  return subtract_product(dot(vector, normal), normal, vector);
}

/// `model` is known at compile time: a kernel runs one of them. With `rolls` false the resistance to rolling and twisting is left
/// out, with `tells_energies` false what springs hold.
template <ContactModel model, bool rolls, bool tells_energies = true, class Number>
ContactForce<Number> contact_force(const ContactConstants<Number>& constants, const ContactMotion<Number>& at,
                                   ContactMemory<Number>& memory) {
  Number width = Number{} + 1, root;
  if constexpr (model == ContactModel::hertz) {
    width = root_of_quotient(at.radius.product * at.overlap, at.radius.sum);
    root = root_of_quotient(width * at.mass.product, at.mass.sum);
  } else {
    root = root_of_quotient(at.mass.product, at.mass.sum);
  }
  const Number opening = dot(at.velocity, at.normal);
  const auto [damped, damping] = dashpots(constants, width, root, at.step);
  const Number spring = constants.normal * width * at.overlap, dashpot = damped * opening, normal = spring - dashpot,
               pressing = maximum(normal, Number{}), stiffness = constants.tangential * width;
  const Triple<Number> sliding = subtract_product(opening, at.normal, at.velocity);
  memory.sliding = across(memory.sliding, at.normal);
  const auto slid = slide(stiffness, damping, Number(constants.friction * pressing), sliding, at.step, memory.sliding);
  ContactForce<Number> result{.normal = normal,
                              .friction = slid.force,
                              .rolling = {},
                              .twisting = {},
                              .elastic_energy = {},
                              .sliding_energy = {},
                              .dashpot_power = dashpot * opening,
                              .sliding_power = Number{} - dot(slid.force, sliding)};
  if constexpr (tells_energies) {
    result.elastic_energy = (model == ContactModel::hertz ? 0.4 : 0.5) * spring * at.overlap;
    result.sliding_energy = 0.5 * stiffness * dot(slid.stretch, slid.stretch);
  }
  if constexpr (rolls) {
    memory.rolling = across(memory.rolling, at.normal);
    const auto rolled = slide(stiffness, damping, Number(constants.rolling * pressing), at.rolling, at.step, memory.rolling);
    const auto twisted = slide(stiffness, damping, Number(constants.twisting * pressing), at.twisting, at.step, memory.twisting);
    result.rolling = rolled.force;
    result.twisting = twisted.force;
    result.sliding_power = result.sliding_power - dot(rolled.force, at.rolling) - twisted.force * at.twisting;
    if constexpr (tells_energies)
      result.sliding_energy =
          result.sliding_energy + 0.5 * stiffness * (dot(rolled.stretch, rolled.stretch) + square_of(twisted.stretch));
  }
  return result;
}

}  // namespace sazare::laws
