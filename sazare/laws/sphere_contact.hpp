#pragma once

/// Contact of two spheres on released faces: a normal spring that never attracts, a dashpot, and friction.
///
///     N = max(0, k d + D)     D = -c v_n        d    overlap beyond the one at the start of the contact [m]
///     |T| <= mu N             T against v_t     v_n  opening speed [m/s];  v_t sliding velocity [m/s]
///
/// The dashpot of [Konno2018], Table 1, is 20 to 800 times critical for the masses of its fragments, and friction knows no
/// speed below which it is small: taken literally both ask for steps of 1e-10 s, and cut to the stability limit of a step they
/// let pressed fragments creep in proportion to the step. So in a step h both are built up by a spring as stiff as the step
/// allows, in series with a dashpot:
///
///     D = E - c' v_n     dE/dt = -s v_n - s E/(c - c')      c' = min(c, m/(4 n h))     s = m/(16 n h^2)
///     T = S - c' v_t     dS/dt = -s v_t                     |S|, |T| <= mu N
///
/// S turns with the plane of contact, so that bodies which turn as one keep it.
///
/// m is the mass that the two bodies show at the point, n the number of contacts that share it; three heavy bodies at a time
/// may touch a light one before the step is unstable. For slow motion D = -c v_n and T is Coulomb's friction, with an
/// error of order h^2. So it is for the cap `step`; `critical` keeps c under critical damping instead, and `literal` takes c
/// as it is.

#include "sazare/core/vector_of.hpp"
#include "sazare/laws/contact_plane.hpp"

namespace sazare::laws {

enum class DampingCap { literal, critical, step };

struct SphereContact {
  Real stiffness = 0;  ///< k [N/m]
  Real damping = 0;    ///< c [N s/m]
  Real friction = 0;   ///< mu [-]
  DampingCap cap = DampingCap::step;
};

/// What the law needs to know of one touching pair of spheres; `T` is Real or Lanes.
template <class T>
struct SphereMotionOf {
  T overlap{};                             ///< d [m], > 0
  T opening_speed{};                       ///< v_n [m/s], positive when the spheres part
  VectorOf<T> sliding = zero_vector<T>();  ///< v_t [m/s]
  T normal_mass{};                         ///< m along the normal [kg]
  T sliding_mass{};                        ///< m along the sliding direction [kg]
  T contacts = T{} + 1.0;                  ///< n
  T step{};                                ///< h, the longer of two evaluations' distances [s]
  T elapsed{};                             ///< since the last evaluation [s]
};

/// What a touching pair remembers until it parts.
template <class T>
struct SphereMemoryOf {
  T dashpot{};                              ///< E [N]
  VectorOf<T> friction = zero_vector<T>();  ///< S [N]

  /// Friction lies in the plane of contact and goes along with it, see `PlaneTurn`.
  void turn(const VectorOf<T>& normal, const VectorOf<T>& tilt, const T& angle) {
    friction = PlaneTurn<T>(normal, tilt, angle).carried(friction);
  }
};

template <class T>
struct SphereForceOf {
  T elastic{};                              ///< k d [N], pushes apart
  T dashpot{};                              ///< D [N], pushes apart when positive
  VectorOf<T> friction = zero_vector<T>();  ///< T [N], on the second sphere
};

using SphereMotion = SphereMotionOf<Real>;
using SphereMemory = SphereMemoryOf<Real>;
using SphereForce = SphereForceOf<Real>;

template <class T>
T capped_damping(const SphereContact& law, const SphereMotionOf<T>& at) {
  const T damping = T{} + law.damping;
  if (law.cap != DampingCap::critical) return damping;
  return minimum(damping, 2.0 * square_root(law.stiffness * at.normal_mass / at.contacts));
}

template <class T>
VectorOf<T> limited(const VectorOf<T>& vector, T length) {
  const T square = dot(vector, vector);
  return select(square > length * length, length / square_root(square), T{} + 1.0) * vector;
}

template <class T>
SphereForceOf<T> sphere_force(const SphereContact& law, const SphereMotionOf<T>& at, SphereMemoryOf<T>& memory) {
  const T calming = 1.0 / (4.0 * at.contacts * at.step), stiffness = calming / (4.0 * at.step);  // times a mass
  const T damping = capped_damping(law, at);
  const T direct = law.cap == DampingCap::step ? minimum(damping, calming * at.normal_mass) : damping;
  SphereForceOf<T> force;
  force.elastic = law.stiffness * at.overlap;
  const T spring = stiffness * at.normal_mass * at.elapsed, slow = damping - direct;
  const T leak = 1.0 + spring / slow;  // infinite where the dashpot is taken as it is
  const T built_up = maximum((memory.dashpot - spring * at.opening_speed) / leak, -force.elastic);
  memory.dashpot = select(slow > 0.0, built_up, memory.dashpot);
  force.dashpot = maximum(memory.dashpot - direct * at.opening_speed, -force.elastic);
  const T most = law.friction * (force.elastic + force.dashpot);
  memory.friction = limited(memory.friction - (stiffness * at.sliding_mass * at.elapsed) * at.sliding, most);
  force.friction = limited(memory.friction - (calming * at.sliding_mass) * at.sliding, most);
  return force;
}

inline Real sphere_energy(const SphereContact& law, Real overlap) { return 0.5 * law.stiffness * overlap * overlap; }

}  // namespace sazare::laws
