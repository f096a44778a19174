#pragma once

/// Contact of two spheres on released faces: a normal spring that never attracts, a dashpot, and friction.
///
///     N = max(0, k d - c v_n)      d    overlap beyond the one at the start of the contact [m]
///     T = min(mu N, m v_t / (2 n h))    v_n  opening speed [m/s];  v_t sliding speed [m/s]
///
/// The dashpot of [Konno2018], Table 1, is 20 to 800 times critical for the masses of its fragments. Taken literally it
/// asks for steps of 1e-10 s; a cap leaves the answers within 2 %: `step` lets n contacts of a pair together take at
/// most half of the closing speed in a step h, `critical` keeps c under critical damping. m is the mass that the two
/// bodies show at the point. Friction takes its direction from the sliding velocity and never reverses it.

#include <algorithm>
#include <cmath>

#include "sazare/core/vector.hpp"

namespace sazare::laws {

enum class DampingCap { literal, critical, step };

struct SphereContact {
  Real stiffness = 0;  ///< k [N/m]
  Real damping = 0;    ///< c [N s/m]
  Real friction = 0;   ///< mu [-]
  DampingCap cap = DampingCap::step;
};

/// What the law needs to know of one touching pair of spheres.
struct SphereMotion {
  Real overlap = 0;         ///< d [m], > 0
  Real opening_speed = 0;   ///< v_n [m/s], positive when the spheres part
  Real sliding_speed = 0;   ///< v_t [m/s], >= 0
  Real normal_mass = 0;     ///< mass shown along the normal [kg]
  Real sliding_mass = 0;    ///< mass shown along the sliding direction [kg]
  Real shared_step = 0;     ///< n h: contacts of the pair times the longer of the two bodies' steps [s]
};

struct SphereForce {
  Real elastic = 0;   ///< k d [N], pushes apart
  Real dashpot = 0;   ///< part of the dashpot [N], pushes apart when positive
  Real friction = 0;  ///< against the sliding [N], >= 0
};

inline Real capped_damping(const SphereContact& law, const SphereMotion& at) {
  switch (law.cap) {
    case DampingCap::critical: return std::min(law.damping, 2 * std::sqrt(law.stiffness * at.normal_mass));
    case DampingCap::step: return std::min(law.damping, at.normal_mass / (2 * at.shared_step));
    case DampingCap::literal: break;
  }
  return law.damping;
}

inline SphereForce sphere_force(const SphereContact& law, const SphereMotion& at) {
  SphereForce force;
  force.elastic = law.stiffness * at.overlap;
  force.dashpot = std::max(-capped_damping(law, at) * at.opening_speed, -force.elastic);
  const Real normal = force.elastic + force.dashpot;
  force.friction = std::min(law.friction * normal, at.sliding_mass * at.sliding_speed / (2 * at.shared_step));
  return force;
}

inline Real sphere_energy(const SphereContact& law, Real overlap) { return 0.5 * law.stiffness * overlap * overlap; }

}  // namespace sazare::laws
