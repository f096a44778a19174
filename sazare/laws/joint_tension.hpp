#pragma once

/// Linear softening of a joint in tension, per unit of area.
///
///     s = k d                        d <= d_e                 d    opening [m], compression negative
///     s = s_t (d_u - d)/(d_u - d_e)  d_e < d < d_u            k    normal stiffness [Pa/m]
///     s = 0, broken                  d >= d_u                 s_t  tensile strength [Pa], d_e = s_t / k
///
/// d_u follows from the fracture energy G = s_t d_u / 2 [N/m]. The largest opening so far, `peak` (at least d_e), is
/// the joint's memory: unloading goes straight to the origin. [Konno2018], 2.1 and fig. 4.

#include <tuple>

#include "sazare/core/lanes.hpp"

namespace sazare::laws {

/// `P` is `Real`, or `Lanes` where every lane has parameters of its own.
template <class P>
struct TensionParameters {
  P stiffness{};        ///< k [Pa/m]
  P strength{};         ///< s_t [Pa]
  P elastic_opening{};  ///< d_e [m]
  P failure_opening{};  ///< d_u [m]

  /// Requires strength^2 <= 2 fracture_energy stiffness: otherwise the joint would be broken before it softens.
  static TensionParameters make(Real stiffness, Real strength, Real fracture_energy) {
    return {stiffness, strength, strength / stiffness, 2 * fracture_energy / strength};
  }

  auto numbers() { return std::tie(stiffness, strength, elastic_opening, failure_opening); }
};

using JointTension = TensionParameters<Real>;

/// From any struct that has stiffness, strength and fracture energy as members, named as the keys of a case are.
template <class Joint>
JointTension joint_tension(const Joint& joint) {
  return JointTension::make(joint.normal_stiffness, joint.tensile_strength, joint.fracture_energy);
}

/// Gives a joint another stiffness; its strength and its fracture energy stay.
template <class P>
void set_stiffness(TensionParameters<P>& law, P stiffness) {
  law.stiffness = stiffness;
  law.elastic_opening = law.strength / stiffness;
}

/// Multiplies the strength, and the opening at failure by a factor of its own: the fracture energy by both.
template <class P>
void scale_strength(TensionParameters<P>& law, P factor, P of_length) {
  law.strength = law.strength * factor;
  law.elastic_opening = law.elastic_opening * factor;
  law.failure_opening = law.failure_opening * of_length;
}

/// The largest stress [Pa] that leaves a joint intact.
template <class P>
P elastic_limit(const TensionParameters<P>& law) {
  return law.strength;
}

/// The largest opening [m] that leaves a joint intact: the memory begins with it.
template <class P>
P elastic_peak(const TensionParameters<P>& law) {
  return law.elastic_opening;
}

/// The opening [m] at which a joint bears nothing any more.
template <class P>
P failure_peak(const TensionParameters<P>& law) {
  return law.failure_opening;
}

/// Whether a joint with this memory has softened.
template <class P, class T>
auto is_softened(const TensionParameters<P>& law, T peak) {
  return peak > law.elastic_opening;
}

/// Whether a joint with this memory bears nothing any more.
template <class P, class T>
auto has_failed(const TensionParameters<P>& law, T peak) {
  return peak >= law.failure_opening;
}

/// Stress [Pa] on the envelope at an opening between d_e and d_u.
template <class P, class T>
T softening_stress(const TensionParameters<P>& law, T opening) {
  const P slope = law.strength / (law.failure_opening - law.elastic_opening);
  return maximum((law.failure_opening - opening) * slope, T{} + 0.0);
}

/// Slope [Pa/m] of the line to the origin on which a joint with this memory unloads.
template <class P, class T>
T unloading_stiffness(const TensionParameters<P>& law, T peak) {
  return select(is_softened(law, peak), softening_stress(law, peak) / peak, T{} + law.stiffness);
}

/// Stress [Pa], tension positive, once `peak` has been raised to the opening if that is larger.
template <class P, class T>
T tension_stress(const TensionParameters<P>& law, T opening, T unloading) {
  return opening * select(opening > 0.0, unloading, T{} + law.stiffness);
}

/// The stress at an opening for a joint of this memory, intact or not.
template <class P, class T>
T softened_stress(const TensionParameters<P>& law, T opening, T peak) {
  return tension_stress(law, opening, unloading_stiffness(law, peak));
}

/// Recoverable energy per area [J/m2]: under the line to the origin.
template <class T>
T tension_energy(T opening, T stress) {
  return 0.5 * opening * stress;
}
template <class P, class T>
T stored_energy(const TensionParameters<P>&, T opening, T stress) {
  return tension_energy(opening, stress);
}

/// Energy per area [J/m2] that fracture has taken for good: the area under the envelope up to `peak` less the
/// triangle that unloading gives back. It is the fracture energy at d_u.
template <class P, class T>
T fracture_dissipation(const TensionParameters<P>& law, T peak) {
  const T end = minimum(peak, T{} + law.failure_opening), stress = softening_stress(law, end);
  const T under_envelope = 0.5 * law.strength * law.elastic_opening + 0.5 * (law.strength + stress) * (end - law.elastic_opening);
  return select(is_softened(law, peak), under_envelope - 0.5 * stress * end, T{} + 0.0);
}

}  // namespace sazare::laws
