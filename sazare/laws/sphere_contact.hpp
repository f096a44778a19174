#pragma once

/// Contact of two spheres on released faces: a normal spring that never attracts, a dashpot, and friction.
///
///     N = max(0, k d + D)     D = -c v_n        d    overlap beyond the one at the start of the contact [m]
///     |T| <= mu N             T against v_t     v_n  opening speed [m/s];  v_t sliding velocity [m/s]
///
/// The dashpot of [Konno2018], Table 1, is 20 to 800 times critical for the masses of its fragments, and friction knows no
/// speed below which it is small: taken literally both ask for steps of 1e-10 s, and cut to what a step bears they let
/// pressed fragments creep in proportion to the step. So in a step h both are built up by a spring as stiff as the step
/// bears, beside a dashpot that calms it:
///
///     D = E - c' v_n     dE/dt = -s v_n - s E/(c - c')      c' = min(c, m/(4 n h))     s = m/(16 n h^2)
///     T = S - c' v_t     dS/dt = -s v_t                     |S|, |T| <= mu N
///
/// m is the mass that the two bodies show at the point, n the number of contacts that share it; three heavy bodies at a time
/// may touch a light one before the step bears no more. For slow motion D = -c v_n and T is Coulomb's friction, with an
/// error of order h^2. So it is for the cap `step`; `critical` keeps c under critical damping instead, and `literal` takes c
/// as it is.

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
  Real overlap = 0;                   ///< d [m], > 0
  Real opening_speed = 0;             ///< v_n [m/s], positive when the spheres part
  Vector3 sliding = Vector3::Zero();  ///< v_t [m/s]
  Real normal_mass = 0;               ///< m along the normal [kg]
  Real sliding_mass = 0;              ///< m along the sliding direction [kg]
  Real contacts = 1;                  ///< n
  Real step = 0;                      ///< h, the longer of two evaluations' distances [s]
  Real elapsed = 0;                   ///< since the last evaluation [s]
};

/// What a touching pair remembers until it parts.
struct SphereMemory {
  Real dashpot = 0;                    ///< E [N]
  Vector3 friction = Vector3::Zero();  ///< S [N]
};

struct SphereForce {
  Real elastic = 0;                    ///< k d [N], pushes apart
  Real dashpot = 0;                    ///< D [N], pushes apart when positive
  Vector3 friction = Vector3::Zero();  ///< T [N], on the second sphere
};

inline Real capped_damping(const SphereContact& law, const SphereMotion& at) {
  if (law.cap != DampingCap::critical) return law.damping;
  return std::min(law.damping, 2 * std::sqrt(law.stiffness * at.normal_mass / at.contacts));
}

inline Vector3 limited(const Vector3& vector, Real length) {
  const Real square = vector.squaredNorm();
  return square > length * length ? Vector3(length / std::sqrt(square) * vector) : vector;
}

inline SphereForce sphere_force(const SphereContact& law, const SphereMotion& at, SphereMemory& memory) {
  const Real calming = 1 / (4 * at.contacts * at.step), stiffness = calming / (4 * at.step);  // times a mass
  const Real damping = capped_damping(law, at);
  const Real direct = law.cap == DampingCap::step ? std::min(damping, calming * at.normal_mass) : damping;
  SphereForce force;
  force.elastic = law.stiffness * at.overlap;
  if (damping > direct) {
    const Real spring = stiffness * at.normal_mass * at.elapsed;
    const Real leak = 1 + spring / (damping - direct);
    memory.dashpot = std::max((memory.dashpot - spring * at.opening_speed) / leak, -force.elastic);
  }
  force.dashpot = std::max(memory.dashpot - direct * at.opening_speed, -force.elastic);
  const Real most = law.friction * (force.elastic + force.dashpot);
  memory.friction = limited(memory.friction - stiffness * at.sliding_mass * at.elapsed * at.sliding, most);
  force.friction = limited(memory.friction - calming * at.sliding_mass * at.sliding, most);
  return force;
}

inline Real sphere_energy(const SphereContact& law, Real overlap) { return 0.5 * law.stiffness * overlap * overlap; }

}  // namespace sazare::laws
