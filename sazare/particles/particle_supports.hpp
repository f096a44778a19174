#pragma once

/// What holds, moves and loads single degrees of freedom of particles.

#include <vector>

#include "sazare/laws/base_motion.hpp"
#include "sazare/laws/ground_motion.hpp"
#include "sazare/state/particles.hpp"

namespace sazare::particles {

/// A degree of freedom of a particle that does not move.
struct HeldFreedom {
  Index particle = 0;
  int freedom = 0;
};

/// One that moves as a history says, times a factor.
struct DrivenFreedom {
  Index particle = 0;
  int freedom = 0;
  Index motion = 0;
  Real factor = 1;
};

/// A viscous boundary: the impedance of the ground beyond, and the wave that comes in through it. The force is
/// -c (v - 2 v_in), besides what it carries at rest: half of it lets waves leave, the other half brings in the wave that would
/// stand alone in the ground beyond. Lysmer and Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969) 859-877. Beside a column that moves
/// as the ground beyond does, v_c takes the place of 2 v_in.
struct Dashpot {
  static constexpr Index no_motion = -1;

  Index particle = 0;
  int freedom = 0;
  Real rate = 0;  ///< c over the mass [1/s]
  Index motion = no_motion;
  Real factor = 1;
  Real reaction = 0;  ///< what the ground beyond carries at rest, over the mass [m/s2]
  bool is_beside_column = false;
  bool settles = false;  ///< is not held while the equilibrium is sought
  Real beyond = 0;       ///< v_c, of a column [m/s]
};

template <int D>
struct ParticleSupports {
  std::vector<laws::GroundMotion> motions;
  std::vector<HeldFreedom> held;
  std::vector<DrivenFreedom> driven;
  std::vector<Dashpot> dashpots;
  Vector<D> gravity = Vector<D>::Zero();  ///< [m/s2]
  laws::BaseMotion base;                  ///< relative to which damping in proportion to the mass acts

  /// Takes the motion of the supports along each axis for that of the base, where it is one.
  void find_base() {
    for (const HeldFreedom& one : held)
      if (one.freedom < D) base.add_support(one.freedom, laws::BaseMotion::none);
    for (const DrivenFreedom& one : driven)
      if (one.freedom < D) base.add_support(one.freedom, one.factor == 1 ? one.motion : laws::BaseMotion::none);
  }
};

}  // namespace sazare::particles
