#pragma once

/// Softening of a joint in mixed mode: opening and slip use up the same strength, per unit of area.
///
///     D   = (p - d_e)/(d_u - d_e) + q/s_u            damage, 0 to 1
///     s_u = 2 G_II/c                                 so that pure slip uses up c with the energy G_II
///     s   = s_t (1 - D) d/p   (d > 0), k d (d < 0)   normal stress, tension positive; s_t, d_e, d_u as in joint_tension.hpp
///     t_max = max(0, c (1 - D) - m(D) s)             shear strength, m(D) = m_p + (m_r - m_p) D
///
/// d    opening [m]                                   c         cohesion [Pa]
/// p    largest opening so far, at least d_e [m]      m_p, m_r  peak and residual coefficient of friction
/// q    path of slip so far [m]                       G_II      shear fracture energy [N/m]
///
/// p and q are the memories of a vertex, besides the slip itself. Without slip this is the law of joint_tension.hpp, and without damage
/// that of joint_shear.hpp. Where opening and slip grow in a fixed proportion, the joint fails where G/G_I + G/G_II of what opening and slip
/// have dissipated reaches 1, up to what is elastic: the linear criterion of mixed-mode fracture.
///
/// A joint whose damage has reached 1 has neither tensile strength nor cohesion. Pressed together it remains a joint with the friction
/// m_r, since its vertices still lie where the faces touch; it breaks, and contact begins, when such a vertex opens, or has slipped by
/// the size of the face.
///
/// A vertex that slips returns to the strength, which falls by H = (c + (m_r - m_p) s)/s_u per slip: from the trial stress t the slip is
/// (t - t_max)/(k_s - H). Where H >= k_s, under high pressure, there is no equilibrium on the way, and the stress falls to the residual
/// strength at once.

#include <optional>

#include "sazare/laws/joint_shear.hpp"
#include "sazare/laws/joint_tension.hpp"
#include "sazare/laws/law_list.hpp"

namespace sazare::laws {

/// `P` is `Real`, or `Lanes` where every lane has parameters of its own.
template <class P>
struct SofteningShear {
  P stiffness{};          ///< k_s [Pa/m]
  P cohesion{};           ///< c [Pa]
  P friction{};           ///< m_p [-]
  P residual_friction{};  ///< m_r [-]
  P failure_slip{};       ///< s_u [m]; the cohesion is above zero

  auto numbers() { return std::tie(stiffness, cohesion, friction, residual_friction, failure_slip); }
};

/// Gives a joint another stiffness; its strength and its fracture energy stay.
template <class P>
void set_stiffness(SofteningShear<P>& law, P stiffness) {
  law.stiffness = stiffness;
}

/// Multiplies the strength without pressure, and the slip that uses it up by a factor of its own: the shear fracture energy by
/// both.
template <class P>
void scale_strength(SofteningShear<P>& law, P factor, P of_length) {
  law.cohesion = law.cohesion * factor;
  law.failure_slip = law.failure_slip * of_length;
}

/// D by the two memories.
template <class P, class T>
T damage(const TensionParameters<P>& tension, const SofteningShear<P>& shear, T peak, T path) {
  const T by_opening = (peak - tension.elastic_opening) / (tension.failure_opening - tension.elastic_opening);
  return minimum(T(by_opening + path / shear.failure_slip), T{} + 1.0);
}

/// Stress [Pa], tension positive.
template <class P, class T>
T damaged_stress(const TensionParameters<P>& law, T opening, T peak, T damage) {
  const T unloading = select(damage > 0.0, T(law.strength * (1.0 - damage) / peak), T{} + law.stiffness);
  return tension_stress(law, opening, unloading);
}

/// Energy per area [J/m2] dissipated by an opening that has raised the memory from `before` to `peak`, and the damage from `damage`.
template <class P, class T>
T opening_dissipation(const TensionParameters<P>& law, T before, T peak, T damage) {
  const T range = law.failure_opening - law.elastic_opening, end = minimum(peak, T(before + (1.0 - damage) * range));
  const T rise = end - before;
  return 0.5 * law.strength * rise * (1.0 - damage - 0.5 * rise / range + 0.5 * (end + before) / range);
}

template <class P, class T>
T shear_strength(const SofteningShear<P>& law, T normal_stress, T damage) {
  const T friction = law.friction + (law.residual_friction - law.friction) * damage;
  return maximum(law.cohesion * (1.0 - damage) - friction * normal_stress, T{} + 0.0);
}

template <class P, class T>
auto slips(const SofteningShear<P>& law, const Slip<T>& at, T strength) {
  const T squared = at.elastic[0] * at.elastic[0] + at.elastic[1] * at.elastic[1];
  return law.stiffness * law.stiffness * squared > strength * strength;
}

/// Shear stress [Pa] after slip from the trial stress: on the falling line of strength, or the residual strength.
template <class P, class T>
T stress_after_slip(const SofteningShear<P>& law, T trial, T strength, T normal_stress, T damage) {
  const T residual = shear_strength(law, normal_stress, T{} + 1.0);
  const T fall = (law.cohesion + (law.residual_friction - law.friction) * normal_stress) / law.failure_slip;
  const auto meets = fall < law.stiffness;
  const T slip = (trial - strength) / select(meets, T(law.stiffness - fall), T{} + 1.0);
  const auto softens = meets & (damage + slip / law.failure_slip < 1.0);
  return maximum(select(softens, T(strength - fall * slip), residual), T{} + 0.0);
}

/// Returns a vertex to its strength and adds to the path of slip. The dissipation is the mean of the strength before and after, times
/// the slip: exact along the falling line.
template <class P, class T>
void slip_and_soften(const SofteningShear<P>& law, SofteningSlip<T>& at, T normal_stress, T damage, T& path) {
  const T strength = shear_strength(law, normal_stress, damage);
  const auto over = slips(law, at, strength);  // the very same question: in lanes, who else slips must not matter
  const T squared = at.elastic[0] * at.elastic[0] + at.elastic[1] * at.elastic[1];
  const T trial = square_root(select(over, T(law.stiffness * law.stiffness * squared), T{} + 1.0));
  const T after = minimum(stress_after_slip(law, trial, strength, normal_stress, damage), trial);
  const T keep = select(over, T(after / trial), T{} + 1.0), slip = select(over, T((trial - after) / law.stiffness), T{});
  const T softening = minimum(slip, T((1.0 - damage) * law.failure_slip));
  path += slip;
  at.dissipation = 0.5 * (strength + after) * slip;
  at.fracture = minimum(T(law.cohesion * (1.0 - damage - 0.5 * softening / law.failure_slip) * softening), at.dissipation);
  for (int axis = 0; axis < 2; ++axis) {
    at.memory[axis] += at.elastic[axis] * (1.0 - keep);
    at.elastic[axis] *= keep;
  }
}

struct MixedMode {
  static constexpr std::string_view word = "mixed_mode";
  static constexpr std::array parameters{
      LawParameter{.name = "shear_fracture_energy",
                   .unit = "N/m",
                   .note = "required for law mixed_mode",
                   .sentence = "Fracture energy in shear, mode II: energy per area that cohesion dissipates, beside friction, when slip "
                               "uses it up."},
      LawParameter{.name = "residual_friction_coefficient",
                   .unit = "",
                   .note = "default: the friction coefficient of the joint",
                   .sentence = "Coefficient of friction of a joint of law mixed_mode without cohesion.",
                   .may_be_zero = true,
                   .may_be_absent = true}};
  static constexpr std::string_view shear_energy = parameters[0].name;

  template <class P>
  using Tension = TensionParameters<P>;
  template <class P>
  using Shear = SofteningShear<P>;

  template <class Joint>
  static JointTension tension(const Joint& joint, const std::array<std::optional<Real>, 2>&) {
    return joint_tension(joint);
  }
  template <class Joint>
  static SofteningShear<Real> shear(const Joint& joint, const std::array<std::optional<Real>, 2>& own) {
    return {joint.shear_stiffness, joint.cohesion, joint.friction_coefficient, own[1].value_or(joint.friction_coefficient),
            2 * own[0].value() / joint.cohesion};
  }
};

}  // namespace sazare::laws
