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
/// How wide the contact is, a, and what the normal spring does, the first term of N, are said by the law: see `Hertz`, which has
/// all that a law must have, and the list of laws in granular/contact_laws.hpp.
///
/// A dashpot is no stronger than a step h bears where a sphere has twelve contacts, as many as equal ones can have: sums of c h/m
/// over them, with spins that go against each other, stay below 1. That is 0.2 m/h along the normal and 0.03 m/h of a slider;
/// contacts that last for more than some 10 steps have weaker dashpots along the normal anyway.
///
/// Where a law slips in part, the slider of T is that of bands, see slip_bands.hpp.
///
/// The stretches lie in the plane of contact and turn with it: as n does, and about n as the two bodies do on average, each counted
/// by its distance from the contact, so that a wall alone counts where there is one. Two bodies that turn as one thus keep
/// their forces ([Luding2008], who counts both alike).

#include "sazare/laws/contact_plane.hpp"
#include "sazare/laws/granular/contact_laws.hpp"
#include "sazare/laws/slider.hpp"
#include "sazare/laws/slip_bands.hpp"

namespace sazare::laws {

/// What the law needs to know of a touching pair.
template <class Number>
struct ContactMotion {
  Number overlap;           ///< d [m], > 0
  Reduced<Number> radius;   ///< R [m]
  Reduced<Number> mass;     ///< m [kg]
  VectorOf<Number> normal = zero_vector<Number>();    ///< n, from the first to the second
  VectorOf<Number> velocity = zero_vector<Number>();  ///< of the second relative to the first where they touch [m/s]
  VectorOf<Number> rolling = zero_vector<Number>();   ///< R (w_2 - w_1) x n [m/s]; read, like the next, where spheres resist to turn on each other
  Number twisting;          ///< R (w_2 - w_1) . n [m/s]
  Number step;              ///< h [s]
  VectorOf<Number> tilt = zero_vector<Number>();      ///< of the normal since the last step, see `PlaneTurn` [rad]
  Number turn;              ///< of the plane of contact about n since the last step [rad]
};

/// Stretches of the sliders that a pair remembers until it parts, see `slide`.
template <class Number>
struct ContactMemory {
  VectorOf<Number> sliding = zero_vector<Number>();  ///< [sqrt(J)]; not used where there are bands, see `SlipBands`
  VectorOf<Number> rolling = zero_vector<Number>();  ///< [sqrt(J)]
  Number twisting{};       ///< [sqrt(J)]
};

template <class Number>
struct ContactForce {
  Number normal{};                                    ///< N on the second, along n [N]
  VectorOf<Number> friction = zero_vector<Number>();  ///< T on the second [N]
  VectorOf<Number> rolling = zero_vector<Number>();   ///< force of the slider of rolling [N]; the moment is R n x it
  Number twisting{};                                  ///< force of the slider of twisting [N]; the moment is R n times it
  Number elastic_energy{};                            ///< of the normal spring [J]
  Number sliding_energy{};                            ///< in the sliders' springs [J]
  Number dashpot_power{};                             ///< taken by the normal dashpot [W]
  Number sliding_power{};                             ///< work against the sliders: stored and lost [W]
};

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

/// With `rolls` false the resistance to rolling and twisting is left out, with `tells_energies` false what springs hold. `bands` are
/// those of a law that slips in part, and not there with others.
template <class Law, bool rolls, bool tells_energies = true, class Number>
ContactForce<Number> contact_force(const ContactConstants<Number>& constants, const ContactMotion<Number>& at,
                                   ContactMemory<Number>& memory, [[maybe_unused]] SlipBands<Number>* bands = nullptr) {
  const Number width = Law::width(constants, at.overlap, at.radius);
  const Number root = root_of_quotient(Number(width * at.mass.product), at.mass.sum);
  const Number opening = dot(at.velocity, at.normal);
  const auto [damped, damping] = dashpots(constants, width, root, at.step);
  const Number spring = Law::force(constants, width, at.overlap, at.radius), dashpot = damped * opening,
               normal = spring - dashpot, pressing = Law::pressing(constants, normal, at.radius),
               spring_root = square_root(Number(constants.tangential * width));
  const VectorOf<Number> sliding = subtract_product(opening, at.normal, at.velocity);
  const PlaneTurn<Number> turned(at.normal, at.tilt, at.turn);
  const auto slid = [&] {
    const Number limit = constants.friction * pressing;
    if constexpr (Law::slips_in_part) {
      for (auto& stretch : bands->stretch) stretch = turned.carried(stretch);
      return slide(constants.tangential, width, damping, limit, sliding, at.step, *bands);
    } else {
      memory.sliding = turned.carried(memory.sliding);
      return slide(spring_root, damping, limit, sliding, at.step, memory.sliding);
    }
  }();
  ContactForce<Number> result{.normal = normal,
                              .friction = slid.force,
                              .rolling = zero_vector<Number>(),
                              .twisting = {},
                              .elastic_energy = {},
                              .sliding_energy = {},
                              .dashpot_power = dashpot * opening,
                              .sliding_power = Number{} - dot(slid.force, sliding)};
  if constexpr (tells_energies) {
    result.elastic_energy = Law::energy(constants, spring, width, at.overlap, at.radius);
    result.sliding_energy = energy_of(slid);
  }
  if constexpr (rolls) {
    memory.rolling = turned.carried(memory.rolling);
    const auto rolled = slide(spring_root, damping, Number(constants.rolling * pressing), at.rolling, at.step, memory.rolling);
    const auto twisted = slide(spring_root, damping, Number(constants.twisting * pressing), at.twisting, at.step, memory.twisting);
    result.rolling = rolled.force;
    result.twisting = twisted.force;
    result.sliding_power = result.sliding_power - dot(rolled.force, at.rolling) - twisted.force * at.twisting;
    if constexpr (tells_energies)
      result.sliding_energy =
          result.sliding_energy + 0.5 * (dot(rolled.stretch, rolled.stretch) + square_of(twisted.stretch));
  }
  return result;
}

}  // namespace sazare::laws
