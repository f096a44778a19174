#pragma once

/// Motion of rigid clumps, and what their spheres have of it.

#include <span>

#include "sazare/methods/spheres/load_table.hpp"
#include "sazare/methods/spheres/stepper/motion.hpp"
#include "sazare/state/clumps.hpp"

namespace sazare::methods::spheres {

/// Loads of one time level on all spheres of a clump, and for how long they act; see TimedLoads.
struct TimedTable {
  const methods::spheres::LoadTable* loads = nullptr;
  Real given = 0, predicted = 0;  ///< [s]
};

/// What a kick gives a clump.
struct ClumpImpulse {
  Vector3 linear = Vector3::Zero();   ///< [N s]
  Vector3 turning = Vector3::Zero();  ///< about its centre [N m s]
};

/// Adds up what pushes the spheres of a clump: returns what a kick gives, and keeps what is predicted besides, of gravity half
/// a step. `place` says by number where a sphere stands.
ClumpImpulse gather(state::Clump& clump, std::span<const state::ClumpMember> members, std::span<const TimedTable> loads,
                    const SphereFlight& flight, std::span<const Index> place);

/// Velocity and angular momentum by an impulse.
void kick(state::Clump& clump, const ClumpImpulse& impulse);

/// Free flight by a step. The turn goes axis by axis (Dullweber, Leimkuhler and McLachlan 1997): symplectic, of second order, and
/// angular momentum stays to the last bit.
void drift(state::Clump& clump, Real step);

/// Places, velocities and spins of a clump's spheres, from its predicted motion.
void place_members(const state::Clump& clump, std::span<const state::ClumpMember> members, std::span<const Index> place,
                   state::Spheres& spheres);

/// Not less than how fast any of a clump's spheres goes around its centre [m/s].
Real turning_speed(const state::Clump& clump, std::span<const state::ClumpMember> members);

struct ClumpEnergies {
  Real translation = 0, rotation = 0, potential = 0;  ///< [J]
};

/// At its time.
ClumpEnergies energies(const state::Clump& clump, const Vector3& gravity);
Vector3 velocity(const state::Clump& clump);
/// About the origin [kg m2/s].
Vector3 angular_momentum(const state::Clump& clump);

}  // namespace sazare::methods::spheres
