#pragma once

/// A natural rock joint by Barton and Bandis, per unit of area: it closes under pressure, and dilates and wears as it slips.
///
///     c = s/k + s V_m/(K_ni V_m + s)      normal: compression of the springs of the elements and of the joint in series,
///     c = w - d                           no stress where c is below 0
///     |t| <= s tan(phi_r + i)             shear
///     i = m(q/q_p) JRC log10(JCS/s)       at least 0, and phi_r + i at most 70 degrees
///     q_p = L/500 (JRC/L)^(1/3)           slip at the peak [m]
///     dw = tan(i/M) dq                    dilation
///
///     s     normal stress, pressure positive [Pa]     JRC, JCS  roughness coefficient [-] and wall strength [Pa]
///     t     shear stress [Pa]                         L         length to which these belong [m]
///     d     opening [m]                               phi_r     residual friction angle
///     w     dilation so far [m]                       V_m       largest closure [m]
///     q     path of slip under pressure so far [m]    K_ni      stiffness with which closing begins [Pa/m]
///     k     stiffness of the springs [Pa/m]           M         damage coefficient, 1 to 2 [-]
///     m     mobilised share of JRC, see `mobilised_roughness`
///
/// Strength and its cap: N. Barton, V. Choubey, Rock Mechanics 10, 1977. q_p, m and the dilation angle i/M: N. Barton, S. Bandis,
/// K. Bakhtar, Int. J. Rock Mech. Min. Sci. 22, 1985. Closure, K_ni and V_m: S. Bandis, A. Lumsden, N. Barton, Int. J. Rock Mech.
/// Min. Sci. 20, 1983. JRC and JCS by length: N. Barton, S. Bandis, Rock Joints (Loen), 1990.
///
/// w and q are the memories of a vertex, besides the slip itself. The normal stress is the slope of an energy at any w. Slip
/// takes the work of the shear stress on it, less that of the pressure on the dilation, each with the mean of the stress before
/// and after: that is the work which the two sides do on the joint from one evaluation to the next and which it does not store,
/// to second order, so the stress as last evaluated is a memory too. The stresses after a slip take energy, however far it goes:
/// the dilation angle is that under the pressure of its end, which is below the angle of friction.
///
/// Deviations: m begins with 0 instead of a share below 0, so that the residual friction is there at once and the springs alone
/// make the first rise; loading and unloading follow one curve of closure; and slip dilates and wears in any direction.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "sazare/laws/joint_shear.hpp"
#include "sazare/laws/law_list.hpp"

namespace sazare::laws {

/// `P` is `Real`, or `Lanes` where every lane has parameters of its own.
template <class P>
struct JointClosure {
  P stiffness{};    ///< k [Pa/m]
  P most{};         ///< V_m [m]
  P half_stress{};  ///< K_ni V_m, above 0: the pressure at which half of it is closed [Pa]

  auto numbers() { return std::tie(stiffness, most, half_stress); }
};

/// Shear of a rough joint.
template <class P>
struct RoughShear {
  P stiffness{};       ///< k_s of the springs [Pa/m]
  P residual_angle{};  ///< phi_r [rad]
  P least_friction{};  ///< tan(phi_r)
  P roughness{};       ///< JRC as radians per natural logarithm of JCS/s
  P wall_strength{};   ///< JCS [Pa]
  P peak_slip{};       ///< q_p [m]
  P dilation{};        ///< 1/M

  auto numbers() { return std::tie(stiffness, residual_angle, least_friction, roughness, wall_strength, peak_slip, dilation); }
};

template <class P>
void set_stiffness(JointClosure<P>& law, P stiffness) {
  law.stiffness = stiffness;
}
template <class P>
void set_stiffness(RoughShear<P>& law, P stiffness) {
  law.stiffness = stiffness;
}

/// It has no strength without pressure.
template <class P>
void scale_strength(JointClosure<P>&, P, P) {}
template <class P>
void scale_strength(RoughShear<P>&, P, P) {}
template <class P>
P elastic_limit(const JointClosure<P>&) {
  return P{};
}

/// The dilation with which the memory of a joint begins; there is no opening at which it fails.
template <class P>
P elastic_peak(const JointClosure<P>&) {
  return P{};
}
template <class P>
P failure_peak(const JointClosure<P>&) {
  return P{};
}

/// Pressure [Pa] by the compression c: the root of s^2/k + (K_ni V_m/k + V_m - c) s = c K_ni V_m.
template <class P, class T>
T closing_pressure(const JointClosure<P>& law, T compression) {
  const T c = maximum(compression, T{}), b = law.half_stress / law.stiffness + law.most - c;
  const T root = square_root(b * b + 4.0 * c * law.half_stress / law.stiffness);
  const auto is_soft = b > 0.0;
  const T sum = select(is_soft, T(root + b), T{} + 1.0);
  return select(is_soft, T(2.0 * c * law.half_stress / sum), T(0.5 * law.stiffness * (root - b)));
}

/// Closure [m] of the joint itself under a pressure.
template <class P, class T>
T closure_under(const JointClosure<P>& law, T pressure) {
  return pressure * law.most / (law.half_stress + pressure);
}

/// Compression [m] of springs and joint under a pressure.
template <class P, class T>
T compression_under(const JointClosure<P>& law, T pressure) {
  return pressure / law.stiffness + closure_under(law, pressure);
}

/// The natural logarithm of 1 + a.
inline Real log_above_one(Real a) { return std::log1p(a); }
inline Lanes log_above_one(Lanes a) {
  for (int lane = 0; lane < lane_count; ++lane) a[lane] = std::log1p(a[lane]);
  return a;
}

/// Energy per area [J/m2] of the springs and the joint under a pressure.
template <class P, class T>
T closing_energy(const JointClosure<P>& law, T pressure) {
  const T closed = log_above_one(T(pressure / law.half_stress)) - pressure / (law.half_stress + pressure);
  return 0.5 * pressure * pressure / law.stiffness + law.half_stress * law.most * closed;
}

/// The same by the stress, tension positive.
template <class P, class T>
T stored_energy(const JointClosure<P>& law, T, T stress) {
  return closing_energy(law, T(-stress));
}

/// The least shear strength that a joint has under a pressure [Pa].
template <class P, class T>
T least_strength(const RoughShear<P>& law, T pressure) {
  return law.least_friction * pressure;
}

template <class P, class T>
auto slips(const RoughShear<P>& law, const Slip<T>& at, T strength) {
  const T squared = at.elastic[0] * at.elastic[0] + at.elastic[1] * at.elastic[1];
  return law.stiffness * law.stiffness * squared > strength * strength;
}

/// Share of JRC that is mobilised at a slip of x times that of the peak. Table 3 of Barton, Bandis and Bakhtar 1985, straight
/// between its rows, from where it is above 0.
inline Real mobilised_roughness(Real x) {
  constexpr std::array<std::array<Real, 2>, 7> rows{{{0.3, 0}, {0.6, 0.75}, {1, 1}, {2, 0.85}, {4, 0.7}, {10, 0.5}, {100, 0}}};
  for (std::size_t n = 1; n < rows.size(); ++n) {
    const auto& [begin, at_begin] = rows[n - 1];
    const auto& [end, at_end] = rows[n];
    if (x < end) return at_begin + (at_end - at_begin) * std::max(x - begin, Real{0}) / (end - begin);
  }
  return 0;
}

/// The largest total friction angle of Barton and Choubey.
inline constexpr Real most_friction_angle = 70 * std::numbers::pi / 180;

/// i [rad] where a share of JRC is mobilised.
inline Real asperity_angle(const RoughShear<Real>& law, Real pressure, Real mobilised) {
  const Real roughness = law.roughness * mobilised;
  if (roughness == 0 || pressure >= law.wall_strength) return 0;
  const Real most = std::max(most_friction_angle - law.residual_angle, Real{0});
  return pressure > 0 ? std::min(roughness * std::log(law.wall_strength / pressure), most) : most;
}

/// JRC at the length of the joint, of which a share is mobilised.
inline Real mobilised_coefficient(const RoughShear<Real>& law, Real mobilised) {
  return mobilised * law.roughness * std::numbers::ln10 * 180 / std::numbers::pi;
}

/// Shear strength [Pa] under a pressure.
inline Real rough_strength(const RoughShear<Real>& law, Real pressure, Real mobilised) {
  return pressure * std::tan(law.residual_angle + asperity_angle(law, pressure, mobilised));
}

/// A vertex of a natural joint.
struct RoughVertex {
  Real elastic[2];     ///< tangential displacement less the slip so far [m]
  Real compression;    ///< c [m]
  Real path;           ///< q [m]
  Real shear_before[2]{};  ///< shear stress as last evaluated [Pa]
  Real pressure_before{};  ///< and pressure [Pa]
  Real slip[2]{};          ///< what is added to the slip [m]
  Real dilation{};         ///< and to the dilation [m]
  Real dissipation{};      ///< energy per area that this takes [J/m2]
};

/// The slip from a displacement e of the springs after which the shear stress is that which the joint bears, when each unit of it
/// compresses the joint by `slope`: never so long that it would bear more.
inline Real slip_to_strength(const JointClosure<Real>& closure, const RoughShear<Real>& law, Real e, Real compression,
                             Real mobilised, Real slope) {
  const auto excess = [&](Real slip) {
    return law.stiffness * (e - slip) - rough_strength(law, closing_pressure(closure, compression + slope * slip), mobilised);
  };
  const Real enough = 1e-13 * law.stiffness * e;
  Real low = 0, at_low = excess(0), high = std::min(at_low / law.stiffness, e), at_high = slope > 0 ? excess(high) : 0;
  if (at_high >= -enough) return high;
  Real weight_low = at_low, weight_high = at_high;  // of the Illinois method, and every fourth round a bisection
  for (int round = 1, last = 0; round < 80 && at_low > enough; ++round) {
    Real slip = low + (high - low) * (round % 4 == 0 ? 0.5 : weight_low / (weight_low - weight_high));
    if (!(slip > low && slip < high)) slip = 0.5 * (low + high);
    if (!(slip > low && slip < high)) break;
    const Real here = excess(slip);
    if (here >= 0) {
      low = slip;
      at_low = weight_low = here;
      if (last > 0) weight_high *= 0.5;
    } else {
      high = slip;
      weight_high = here;
      if (last < 0) weight_low *= 0.5;
    }
    last = here >= 0 ? 1 : -1;
  }
  return low;
}

/// Lets a vertex slip if it must; returns whether it does. An open joint follows without wear.
inline bool slide(const JointClosure<Real>& closure, const RoughShear<Real>& law, RoughVertex& at) {
  const Real e = std::hypot(at.elastic[0], at.elastic[1]), before = closing_pressure(closure, at.compression);
  const Real mobilised = mobilised_roughness(at.path / law.peak_slip), strength = rough_strength(law, before, mobilised);
  if (!(law.stiffness * e > strength)) return false;
  Real slip = e, slope = 0, pressure = before;
  if (before > 0) {
    const auto solve = [&] {
      slope = std::tan(law.dilation * asperity_angle(law, pressure, mobilised));
      slip = slip_to_strength(closure, law, e, at.compression, mobilised, slope);
      pressure = closing_pressure(closure, at.compression + slope * slip);
    };
    solve();
    if (slope > 0) solve();  // by the pressure at the end, so that the dilation angle is below that of friction
    at.path += slip;
  }
  at.dilation = slope * slip;
  Real work = -0.5 * (at.pressure_before + pressure) * at.dilation;
  for (int axis = 0; axis < 2; ++axis) {
    at.slip[axis] = at.elastic[axis] * (slip / e);
    at.elastic[axis] -= at.slip[axis];
    work += 0.5 * (at.shear_before[axis] + law.stiffness * at.elastic[axis]) * at.slip[axis];
  }
  at.dissipation = std::max(work, Real{0});  // below 0 only where one step goes from rest to far slip
  at.compression += at.dilation;
  return true;
}

/// The share of a dashpot's stress that acts beside a shear stress: friction bounds what both bear together [Pa].
inline Real damping_share(const std::array<Real, 2>& stress, const std::array<Real, 2>& dashpot, Real strength) {
  const Real squared = dashpot[0] * dashpot[0] + dashpot[1] * dashpot[1], along = stress[0] * dashpot[0] + stress[1] * dashpot[1],
             left = std::max(strength * strength - stress[0] * stress[0] - stress[1] * stress[1], Real{0});
  if (squared + 2 * along <= left) return 1;
  const Real root = std::sqrt(along * along + squared * left);
  return along < 0 ? (root - along) / squared : left / std::max(root + along, std::numeric_limits<Real>::min());
}

/// K_ni [Pa/m] of a joint in its first cycle of loading, from its aperture [m]. Bandis, Lumsden and Barton, 1983.
inline Real estimated_initial_stiffness(Real jrc, Real jcs, Real aperture) {
  return 1e9 * (-7.15 + 1.75 * jrc + 0.02 * (1e-6 * jcs) / (1e3 * aperture));
}

/// V_m [m] of a joint in its first cycle of loading, from its aperture [m]. Bandis, Lumsden and Barton, 1983.
inline Real estimated_closure(Real jrc, Real jcs, Real aperture) {
  return 1e-3 * (-0.2960 - 0.0056 * jrc + 2.2410 * std::pow((1e-6 * jcs) / (1e3 * aperture), -0.2450));
}

struct BartonBandis {
  static constexpr std::string_view word = "barton_bandis";
  static constexpr std::string_view required = "required for law barton_bandis";
  static constexpr std::string_view by_test = "for law barton_bandis, with the other of the two, instead of joint_aperture";
  static constexpr std::array parameters{
      LawParameter{.name = "jrc",
                   .unit = "",
                   .note = required,
                   .sentence = "Joint roughness coefficient JRC, 0 to 20.",
                   .may_be_zero = true},
      LawParameter{.name = "jcs",
                   .unit = "Pa",
                   .note = required,
                   .sentence = "Joint wall compressive strength JCS, at least 0.1 MPa.",
                   .usual_least = 3e6,
                   .usual_most = 500e6},
      LawParameter{.name = "residual_friction_angle",
                   .unit = "deg",
                   .note = required,
                   .sentence = "Residual friction angle of the joint, that of a JRC of 0; below 70 deg.",
                   .may_be_zero = true,
                   .usual_least = 5,
                   .usual_most = 60},
      LawParameter{.name = "joint_length",
                   .unit = "m",
                   .note = required,
                   .sentence = "Length of the joint in the ground, between others that cross it: its peak is at a slip of "
                               "L/500 (JRC/L)^(1/3).",
                   .usual_least = 0.01,
                   .usual_most = 100},
      LawParameter{.name = "laboratory_length",
                   .unit = "m",
                   .note = "default: joint_length",
                   .sentence =
                       "Length of the specimens that have jrc and jcs, at most joint_length. Of a longer joint both are less, by "
                       "the scale correction of Bandis.",
                   .may_be_absent = true,
                   .usual_least = 0.01,
                   .usual_most = 5},
      LawParameter{.name = "joint_aperture",
                   .unit = "m",
                   .note = "for law barton_bandis; without it and tests the joint itself does not close",
                   .sentence =
                       "Aperture of the joint under a small stress, at most 5 mm, from which its closure is estimated; the "
                       "closure must come out below the aperture.",
                   .may_be_absent = true,
                   .usual_least = 1e-5,
                   .usual_most = 2e-3},
      LawParameter{.name = "initial_normal_stiffness",
                   .unit = "Pa/m",
                   .note = by_test,
                   .sentence = "Normal stiffness K_ni with which closure of the joint begins.",
                   .may_be_absent = true,
                   .usual_least = 1e8,
                   .usual_most = 1e13},
      LawParameter{.name = "maximum_closure",
                   .unit = "m",
                   .note = by_test,
                   .sentence = "Largest closure V_m of the joint.",
                   .may_be_absent = true,
                   .usual_least = 1e-6,
                   .usual_most = 2e-3},
      LawParameter{
          .name = "damage_coefficient",
          .unit = "",
          .note = "default for law barton_bandis: 2",
          .sentence = "Damage coefficient M, 1 to 2: the dilation angle is 1/M of what roughness adds to the friction angle.",
          .may_be_absent = true}};
  enum Place {
    jrc,
    jcs,
    residual_friction_angle,
    joint_length,
    laboratory_length,
    joint_aperture,
    initial_stiffness,
    most,
    damage
  };
  using Own = std::array<std::optional<Real>, parameters.size()>;

  /// JRC of the joint in the ground.
  static Real roughness_of(const Own& own) { return *own[jrc] * std::pow(length_ratio(own), -0.02 * *own[jrc]); }
  /// JCS of the joint in the ground [Pa].
  static Real wall_strength_of(const Own& own) { return *own[jcs] * std::pow(length_ratio(own), -0.03 * *own[jrc]); }
  /// K_ni [Pa/m]; 0 where the joint does not close.
  static Real initial_stiffness_of(const Own& own) {
    return own[joint_aperture] ? estimated_initial_stiffness(*own[jrc], *own[jcs], *own[joint_aperture])
                               : own[initial_stiffness].value_or(0);
  }
  /// V_m [m]; 0 where the joint does not close.
  static Real closure_of(const Own& own) {
    return own[joint_aperture] ? estimated_closure(*own[jrc], *own[jcs], *own[joint_aperture]) : own[most].value_or(0);
  }

  template <class P>
  using Tension = JointClosure<P>;
  template <class P>
  using Shear = RoughShear<P>;

  template <class Joint>
  static JointClosure<Real> tension(const Joint& joint, const Own& own) {
    const Real closure = closure_of(own);
    return {joint.normal_stiffness, closure, closure > 0 ? initial_stiffness_of(own) * closure : 1};
  }
  template <class Joint>
  static RoughShear<Real> shear(const Joint& joint, const Own& own) {
    constexpr Real degree = std::numbers::pi / 180;
    const Real residual = *own[residual_friction_angle] * degree, jrc_there = roughness_of(own), length = *own[joint_length];
    return {joint.shear_stiffness,      residual,
            std::tan(residual),         jrc_there * degree / std::numbers::ln10,
            wall_strength_of(own),      length / 500 * (jrc_there > 0 ? std::cbrt(jrc_there / length) : 1),
            1 / own[damage].value_or(2)};
  }

private:
  static Real length_ratio(const Own& own) { return own[laboratory_length] ? *own[joint_length] / *own[laboratory_length] : 1; }
};

}  // namespace sazare::laws
