#pragma once

/// Bond of two spheres: a beam between their centres that resists stretch, shear, bending and twist at any rotation.
///
///     U = K/2 (l - L)^2 + S/2 (2 - (a + b).e) + (B - S/4 - T)(1 - a.b) + 2 T |v|^2
///
///     l, e   distance of the centres [m] and direction from the first to the second;  L  l at the beginning
///     a, b   directions fixed to the first and the second sphere that were e at the beginning
///     v      axis of the rotation from the first to the second times the sine of half its angle [-]
///     K      stiffness against stretch [N/m]          S  12 E I/(L (1 + f)), against shear [N m]
///     B      E I/L, against bending [N m]             T  G J/L, against twist [N m]
///
/// Force and moments are the exact derivatives of U, so that energy and angular momentum are kept at any rotation; rigid motions
/// do nothing. For small angles U is the energy of the beam element of Timoshenko, f = 12 E I/(k G A L^2), whose nodes are where
/// beam theory has them under loads at its nodes. The form is that of [Kuzkin2012], written without the two directions
/// across the bond: the sum over three directions of their cross products is 4 w v, w being the cosine of half the angle.
///
/// A bond of the stiffnesses k_n and k_s per area [Pa/m] [Potyondy2004] has K = k_n A, S = k_s A L^2, B = k_n I, T = k_s J.
///
/// Stresses at its rim, of beam theory:
///
///     s = (N + 4 M/r)/A      t = (V + 2 |Q|/r)/A      u = max(s/s_t, t/(c + tan(phi) max(-N/A, 0)))
///
///     N, V, M, Q   tension [N], shear force [N], the larger bending moment of its ends and its twisting moment [N m]
///     r, A         radius of the bond [m], its cross-section [m2]
///     s_t, c, phi  tensile strength [Pa], cohesion [Pa], friction angle
///
/// u is the use of its strength by the stresses of the sound bond. The largest u so far, m, weakens it:
///
///     d = 1 for m <= 1     d = (m_u - m)/(m (m_u - 1)) for 1 < m < m_u     broken at m_u
///
/// All of U but the energy of compression is multiplied by d. A bond under tension alone dissipates A G, where m_u = 2 G k/s_t^2,
/// k being its stiffness per area and G the fracture energy [J/m2]; m_u = 1 is brittle.

#include <cmath>
#include <limits>
#include <numbers>

#include "sazare/core/turn.hpp"

namespace sazare::laws {

template <class Number>
struct BondStiffness {
  Number length{};   ///< L [m]
  Number stretch{};  ///< K [N/m]
  Number shear{};    ///< S [N m]
  Number bend{};     ///< B [N m]
  Number twist{};    ///< T [N m]
};

/// A round beam; its shear coefficient is that of [Cowper1966].
inline BondStiffness<Real> beam_stiffness(Real length, Real radius, Real youngs_modulus, Real poisson_ratio) {
  const Real shear_modulus = 0.5 * youngs_modulus / (1 + poisson_ratio),
             coefficient = 6 * (1 + poisson_ratio) / (7 + 6 * poisson_ratio);
  const Real area = std::numbers::pi * radius * radius, second_moment = 0.25 * area * radius * radius;
  const Real bend = youngs_modulus * second_moment / length,
             shear_share = 12 * youngs_modulus * second_moment / (coefficient * shear_modulus * area * length * length);
  return {length, youngs_modulus * area / length, 12 * bend / (1 + shear_share), bend,
          shear_modulus * 2 * second_moment / length};
}

/// A cemented contact, by its stiffnesses per area [Pa/m].
inline BondStiffness<Real> cement_stiffness(Real length, Real radius, Real normal_stiffness, Real shear_stiffness) {
  const Real area = std::numbers::pi * radius * radius, second_moment = 0.25 * area * radius * radius;
  return {length, normal_stiffness * area, shear_stiffness * area * length * length, normal_stiffness * second_moment,
          shear_stiffness * 2 * second_moment};
}

template <class Number>
struct BondPose {
  VectorOf<Number> apart = zero_vector<Number>();      ///< from the first centre to the second [m]
  Turn<Number> first;                                  ///< of the first sphere since the beginning
  Turn<Number> second;                                 ///< of the second sphere
  VectorOf<Number> direction = zero_vector<Number>();  ///< e at the beginning
};

template <class Number>
struct BondForce {
  VectorOf<Number> direction = zero_vector<Number>();      ///< e
  VectorOf<Number> force = zero_vector<Number>();          ///< on the second sphere [N]; the other way on the first
  VectorOf<Number> first_moment = zero_vector<Number>();   ///< on the first sphere [N m]
  VectorOf<Number> second_moment = zero_vector<Number>();  ///< on the second sphere [N m]
  Number compression{};                                    ///< energy that damage leaves [J]
  Number energy{};                                         ///< all other energy, of the sound bond [J]
};

/// Force of a bond that keeps the share `kept` of its stiffness, d.
template <class Number>
BondForce<Number> bond_force(const BondStiffness<Number>& bond, const BondPose<Number>& at, const Number& kept) {
  BondForce<Number> result;
  const Number length = square_root(dot(at.apart, at.apart)), inverse = 1.0 / length;
  const VectorOf<Number> e = inverse * at.apart, a = turned(at.first, at.direction), b = turned(at.second, at.direction);
  const Turn<Number> turn = turn_between(at.first, at.second);
  const Number opening = length - bond.length, tension = bond.stretch * opening;
  const Number half_shear = 0.5 * bond.shear, bend = bond.bend - 0.25 * bond.shear - bond.twist;
  const VectorOf<Number> sum = a + b, across = sum - dot(sum, e) * e;
  const auto opens = opening > 0.0;
  const Number kept_tension = select(opens, Number(kept * tension), tension);
  result.direction = e;
  result.force = (kept * half_shear * inverse) * across - kept_tension * e;
  const VectorOf<Number> along = bend * cross(a, b) + (2.0 * bond.twist * turn.w) * turn.axis();
  result.first_moment = kept * (half_shear * cross(a, e) + along);
  result.second_moment = kept * (half_shear * cross(b, e) - along);
  const VectorOf<Number> first_off = a - e, second_off = b - e, off = a - b;
  const Number stretching = 0.5 * tension * opening;
  result.compression = select(opens, Number{}, stretching);
  result.energy = select(opens, stretching, Number{}) +
                  0.5 * half_shear * (dot(first_off, first_off) + dot(second_off, second_off)) + 0.5 * bend * dot(off, off) +
                  2.0 * bond.twist * dot(turn.axis(), turn.axis());
  return result;
}

/// What a bond withstands; infinite where it does not break.
template <class Number>
struct BondStrength {
  Number tensile{};   ///< s_t [Pa]
  Number cohesion{};  ///< c [Pa]
  Number friction{};  ///< tan(phi) [-]
  Number ultimate{};  ///< m_u [-], at least 1
};

/// m_u of a bond of stiffness k per area [Pa/m], of which the fracture energy is G [J/m2]; below 1 where G is less than the bond
/// holds when it begins to fail.
inline Real ultimate_use(Real tensile_strength, Real stiffness, Real fracture_energy) {
  return 2 * fracture_energy * stiffness / (tensile_strength * tensile_strength);
}

/// u of the sound bond. `force` is that of a bond with kept = 1.
template <class Number>
Number bond_use(const BondStrength<Number>& strength, const BondForce<Number>& force, const Number& radius) {
  const Number per_area = 1.0 / (std::numbers::pi * radius * radius), arm = 4.0 / radius;
  const Number tension = Number{} - dot(force.force, force.direction);
  const VectorOf<Number> across = force.force + tension * force.direction;
  const auto bending_squared = [&](const VectorOf<Number>& moment, const Number& twist) {
    return maximum(Number(dot(moment, moment) - twist * twist), Number{});
  };
  const Number twist = dot(force.second_moment, force.direction), other_twist = dot(force.first_moment, force.direction);
  const Number bending =
      square_root(maximum(bending_squared(force.first_moment, other_twist), bending_squared(force.second_moment, twist)));
  const Number normal_stress = per_area * (tension + arm * bending),
               shear_stress =
                   per_area * (square_root(dot(across, across)) + 0.5 * arm * maximum(twist, Number(Number{} - twist)));
  const Number pressing = maximum(Number(Number{} - per_area * tension), Number{});
  return maximum(Number(normal_stress / strength.tensile),
                 Number(shear_stress / (strength.cohesion + strength.friction * pressing)));
}

/// d after a largest use.
template <class Number>
Number kept_stiffness(const Number& largest_use, const Number& ultimate) {
  const Number one = Number{} + 1.0;
  const auto softens = largest_use > 1.0;
  const Number width = maximum(Number(ultimate - 1.0), Number(Number{} + 1e-300));
  const Number soft = maximum(Number((ultimate - largest_use) / (width * maximum(largest_use, one))), Number{});
  const Number kept = select(softens, soft, one);
  return select(largest_use < ultimate, kept, Number{});
}

/// Dashpots of a bond, between the points in its middle.
template <class Number>
struct BondDamping {
  Number along{};    ///< [N s/m]
  Number across{};   ///< [N s/m]
  Number turning{};  ///< [N m s]
};

template <class Number>
struct BondDrag {
  VectorOf<Number> force = zero_vector<Number>();   ///< on the second sphere [N]
  VectorOf<Number> arm = zero_vector<Number>();     ///< moment of the force on either sphere [N m]
  VectorOf<Number> moment = zero_vector<Number>();  ///< on the second sphere, the other way on the first [N m]
  Number power{};                                   ///< taken [W]
};

/// `velocity` and `turning` are those of the second sphere relative to the first [m/s, rad/s], `mean_spin` the mean of both.
template <class Number>
BondDrag<Number> bond_drag(const BondDamping<Number>& damping, const VectorOf<Number>& apart, const VectorOf<Number>& direction,
                           const VectorOf<Number>& velocity, const VectorOf<Number>& turning, const VectorOf<Number>& mean_spin) {
  const VectorOf<Number> sliding = velocity - cross(mean_spin, apart);
  const Number opening = dot(sliding, direction);
  BondDrag<Number> drag;
  drag.force = zero_vector<Number>() - (damping.along * opening) * direction - damping.across * (sliding - opening * direction);
  drag.arm = (Number{} + 0.5) * cross(drag.force, apart);
  drag.moment = zero_vector<Number>() - damping.turning * turning;
  drag.power = Number{} - dot(drag.force, sliding) - dot(drag.moment, turning);
  return drag;
}

}  // namespace sazare::laws
