#pragma once

/// Motion of rigid clumps, and what their spheres have of it.

#include <span>

#include "sazare/methods/spheres/load_table.hpp"
#include "sazare/state/clumps.hpp"

namespace sazare::engine {

/// Adds up what pushes the spheres of a clump; `place` says by number where a sphere stands.
void gather_loads(state::Clumps& clumps, std::size_t clump, const methods::spheres::LoadTable& loads,
                  std::span<const Index> place);

/// Velocity and angular momentum by so much time of the forces kept and of gravity.
void kick(state::Clump& clump, const Vector3& gravity, Real time);

/// Free flight by a step. The turn goes axis by axis (Dullweber, Leimkuhler and McLachlan 1997): symplectic, of second order, and
/// angular momentum stays to the last bit.
void drift(state::Clump& clump, Real step);

/// Places, velocities and spins of a clump's spheres, from its foreseen motion.
void place_members(const state::Clumps& clumps, std::size_t clump, const Vector3& gravity, Real step,
                   std::span<const Index> place, state::Spheres& spheres);

/// Not less than how fast any of a clump's spheres goes around its centre [m/s].
Real turning_speed(const state::Clumps& clumps, std::size_t clump);

struct ClumpEnergies {
  Real translation = 0, rotation = 0, potential = 0;  ///< [J]
};

/// At the time of the forces kept.
ClumpEnergies energies(const state::Clump& clump, const Vector3& gravity, Real step);
Vector3 velocity(const state::Clump& clump, const Vector3& gravity, Real step);
/// About the origin [kg m2/s].
Vector3 angular_momentum(const state::Clump& clump, const Vector3& gravity, Real step);

}  // namespace sazare::engine
