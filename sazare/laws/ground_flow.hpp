#pragma once

/// Stress of broken ground, which moves far: Mohr-Coulomb strength (laws/mohr_coulomb.hpp) in rates, on the present
/// configuration.
///
/// In a step the relative displacements of a neighbourhood have the gradient G about the configuration in the middle of the step:
///
///     e = sym G,  w = skew G,   Q = (1 - w/2)^-1 (1 + w/2)                        strain and rotation
///     s' = Q s Q^T + C e                                                          elastic trial
///     s  = return of s' to the strength,  e_p = C^-1 (s' - s)                     plastic strain
///     W  = (Q s_old Q^T + s) : e_p / 2                                            dissipated per volume
///
/// A rigid rotation of any size has e = 0 and turns the stress: Hughes and Winget, Int. J. Num. Meth. Eng. 15 (1980) 1862-1867.
/// The elastic energy s C^-1 s/2 and W are together exactly (Q s_old Q^T + s) : e / 2, the work of the mean stress, as the energy
/// balance of a leapfrog step counts it.
///
/// Ground without dilation that flows coaxially would slide on a plane with sin(phi), not tan(phi) (Davis 1968), since its stress
/// turns until it agrees with the flow. Grains slide on both planes on which the strength is reached, tan(phi) on each, so the
/// axes of flow may differ from those of stress by up to phi/2 (de Josselin de Jong, Geotechnique 21 (1971) 155-163). The plane
/// that slides in simple shear is the one that does not turn with the ground: the stress is turned against the rotation, in the
/// plane of the largest and smallest trial stress and in the circle of Mohr, radii r' before and r after the return, by
///
///     a (w/g),  a = phi - asin(r sin(phi)/r'),     g the radius of the strain in this plane, |w/g| at most 1.
///
/// Broken ground has no cohesion, no tensile strength and no dilation. It separates where its stress would be tensile; the volume
/// strain of the opening is kept, and until it has closed again there is no stress: Dunatunga and Kamrin, J. Fluid Mech. 779
/// (2015) 483-513, with the opening in place of the density.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "sazare/core/rotation.hpp"
#include "sazare/laws/mohr_coulomb.hpp"

namespace sazare::laws {

/// What broken ground remembers.
template <int D>
struct GroundState {
  Rotation<D> stress = Rotation<D>::Zero();  ///< s [Pa]; of the volume at the beginning
  Real opening = 0;                          ///< volume strain of its gaps [-]
};

/// What a step did to it.
template <int D>
struct GroundStep {
  Rotation<D> plastic = Rotation<D>::Zero();  ///< e_p [-]
  Real slip = 0;                              ///< largest difference of its principal parts, or the largest opening [-]
  Real dissipated = 0;                        ///< W [J/m3]
};

/// C e.
template <int D>
Rotation<D> elastic_stress(const Elasticity& elastic, const Rotation<D>& strain) {
  return 2 * elastic.shear_modulus * strain + elastic.lame * strain.trace() * Rotation<D>::Identity();
}

/// C^-1 s.
template <int D>
Rotation<D> elastic_strain(const Elasticity& elastic, const Rotation<D>& stress) {
  const Real mean = elastic.lame / (2 * elastic.shear_modulus + D * elastic.lame) * stress.trace();
  return (stress - mean * Rotation<D>::Identity()) / (2 * elastic.shear_modulus);
}

/// Per volume [J/m3].
template <int D>
Real elastic_energy(const Elasticity& elastic, const Rotation<D>& stress) {
  return 0.5 * stress.cwiseProduct(elastic_strain<D>(elastic, stress)).sum();
}

inline MohrCoulomb broken_strength(MohrCoulomb law) {
  law.cohesion = law.tensile_strength = law.sin_dilation = 0;
  return law;
}

/// The stress that a trial stress returns to in a step with this strain and spin tensor.
template <int D>
Rotation<D> returned_stress(const MohrCoulomb& law, const Elasticity& elastic, const Rotation<D>& trial,
                            const Rotation<D>& strained, const Rotation<D>& spin_tensor) {
  constexpr int last = D - 1;
  Eigen::SelfAdjointEigenSolver<Rotation<D>> solver;
  solver.computeDirect(trial);
  const Vector<D>& before = solver.eigenvalues();  // increasing
  if (law.bears(before[last], before[0])) return trial;
  const Vector<D> strain = elastic_strain<D>(elastic, before.asDiagonal()).diagonal();
  std::array<Real, D> parts;
  for (int i = 0; i < D; ++i) parts[static_cast<std::size_t>(i)] = strain[i];
  const auto flow = plastic_flow<D>(law, elastic, parts);
  for (int i = 0; i < D; ++i) parts[static_cast<std::size_t>(i)] -= flow.strain[static_cast<std::size_t>(i)];
  const auto after = elastic.stress(parts);
  Rotation<D> principal = Rotation<D>::Zero();
  for (int i = 0; i < D; ++i) principal(i, i) = after[static_cast<std::size_t>(i)];
  const Rotation<D>& axes = solver.eigenvectors();
  const Real radius = 0.5 * (principal(last, last) - principal(0, 0)), trial_radius = 0.5 * (before[last] - before[0]);
  if (radius > 0 && trial_radius > radius) {
    const Real friction = std::asin(law.sin_friction);
    const Real most = std::max(friction - std::asin(radius / trial_radius * law.sin_friction), Real{0});
    const Rotation<D> in_axes = axes.transpose() * strained * axes, turned = axes.transpose() * spin_tensor * axes;
    const Real sheared = std::hypot(0.5 * (in_axes(last, last) - in_axes(0, 0)), in_axes(0, last));
    const Real back = sheared > 0 ? 0.5 * most * std::clamp(turned(last, 0) / sheared, Real{-1}, Real{1}) : 0;
    const Real middle = 0.5 * (principal(0, 0) + principal(last, last));
    principal(last, last) = middle + radius * std::cos(2 * back);
    principal(0, 0) = middle - radius * std::cos(2 * back);
    principal(0, last) = principal(last, 0) = radius * std::sin(2 * back);
  }
  return axes * principal * axes.transpose();
}

/// `strain` is e, `spin_tensor` is w.
template <int D>
GroundStep<D> advance_ground(const MohrCoulomb& strength, const Elasticity& elastic, const Rotation<D>& strain,
                             const Rotation<D>& spin_tensor, GroundState<D>& state) {
  const Rotation<D> one = Rotation<D>::Identity(), half_spin = 0.5 * spin_tensor;
  const Rotation<D> turn = (one - half_spin).inverse() * (one + half_spin);
  const Rotation<D> old = turn * state.stress * turn.transpose();
  GroundStep<D> step;
  Real share = 1;  // of the strain after the opening has closed
  if (state.opening > 0) {
    const Real opened = state.opening + strain.trace();
    share = opened < 0 ? opened / strain.trace() : 0;
    state.opening = std::max(opened, Real{0});
  }
  const Rotation<D> trial = old + elastic_stress<D>(elastic, share * strain);
  if (share > 0) state.stress = returned_stress<D>(broken_strength(strength), elastic, trial, strain, spin_tensor);
  constexpr Real nothing = 1e-12;  // of the trial stress
  const bool separates = share > 0 && state.stress.norm() <= nothing * trial.norm();
  if (separates) state.stress.setZero();
  const Rotation<D> flow = elastic_strain<D>(elastic, trial - state.stress);
  if (separates) state.opening += std::max(flow.trace(), Real{0});
  step.plastic = flow + (1 - share) * strain;
  step.dissipated = 0.5 * step.plastic.cwiseProduct(old + state.stress).sum();
  const Vector<D> parts = Eigen::SelfAdjointEigenSolver<Rotation<D>>().computeDirect(step.plastic, Eigen::EigenvaluesOnly).eigenvalues();
  step.slip = std::max(parts[D - 1], Real{0}) - std::min(parts[0], Real{0});
  return step;
}

}  // namespace sazare::laws
