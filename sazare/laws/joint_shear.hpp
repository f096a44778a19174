#pragma once

/// Coulomb slip of a bonded joint with cohesion, per unit of area.
///
///     t = k_s |d|,  d = u - u_0                   u    tangential relative displacement [m]
///     |t| <= t_max = max(0, c - mu s)             u_0  slip so far [m], the joint's memory
///     u_0 += d (1 - t_max / (k_s |d|))  on slip   s    normal stress [Pa], tension positive; c cohesion [Pa]
///
/// Slip never breaks a face by itself. [Konno2018], eqs. (1), (2) and fig. 3; the floor of t_max at zero is ours.

#include <tuple>

#include "sazare/core/lanes.hpp"

namespace sazare::laws {

/// `P` is `Real`, or `Lanes` where every lane has parameters of its own.
template <class P>
struct ShearParameters {
  P stiffness{};  ///< k_s [Pa/m]
  P cohesion{};   ///< c [Pa]
  P friction{};   ///< mu [-]

  auto numbers() { return std::tie(stiffness, cohesion, friction); }
};

using JointShear = ShearParameters<Real>;

/// Gives a joint another stiffness; its strength stays.
template <class P>
void set_stiffness(ShearParameters<P>& law, P stiffness) {
  law.stiffness = stiffness;
}

/// Multiplies the strength without pressure; it has no length of softening.
template <class P>
void scale_strength(ShearParameters<P>& law, P factor, P) {
  law.cohesion = law.cohesion * factor;
}

/// Elastic tangential displacement and the slip behind it, in the two directions of the face.
template <class T>
struct Slip {
  T elastic[2];     ///< u - u_0 [m]
  T memory[2];      ///< u_0 [m]
  T dissipation{};  ///< energy per area taken by this slip [J/m2]
};

/// What slip does to a vertex of a law that softens by slip.
template <class T>
struct SofteningSlip : Slip<T> {
  T fracture{};  ///< that part of the dissipation which the loss of cohesion has taken [J/m2]
};

/// Shear strength [Pa] under the normal stress (tension positive).
template <class P, class T>
T shear_strength(const ShearParameters<P>& law, T normal_stress) {
  return maximum(law.cohesion - law.friction * normal_stress, T{} + 0.0);
}

template <class P, class T>
auto slips(const ShearParameters<P>& law, const Slip<T>& at, T strength) {
  const T squared = at.elastic[0] * at.elastic[0] + at.elastic[1] * at.elastic[1];
  return law.stiffness * law.stiffness * squared > strength * strength;
}

/// Returns the elastic displacement to the Coulomb line and adds up the work of the slip at the strength. With the stress t before,
/// that is (t - t_max) t_max / k_s.
template <class P, class T>
void slip_back(const ShearParameters<P>& law, Slip<T>& at, T strength) {
  const T squared = at.elastic[0] * at.elastic[0] + at.elastic[1] * at.elastic[1];
  const auto over = slips(law, at, strength);  // the very same question: in lanes, who else slips must not matter
  const T stress_squared = select(over, law.stiffness * law.stiffness * squared, T{} + 1.0);
  const T inverse_stress = inverse_square_root(stress_squared), keep = select(over, strength * inverse_stress, T{} + 1.0);
  const T lost = 1.0 - keep, compliance = 1.0 / (T{} + law.stiffness);
  at.dissipation = lost * (stress_squared * inverse_stress) * strength * compliance;
  for (int axis = 0; axis < 2; ++axis) {
    at.memory[axis] += at.elastic[axis] * lost;
    at.elastic[axis] *= keep;
  }
}

}  // namespace sazare::laws
