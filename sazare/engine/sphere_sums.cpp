/// What a body of spheres holds as a whole.

#include "sazare/engine/clump_motion.hpp"
#include "sazare/engine/sphere_stepper.hpp"

namespace sazare::engine {

SphereEnergies SphereStepper::energies() const {
  SphereEnergies energies;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    if (!(spheres_.kick[i].inverse_mass > 0)) continue;
    energies.translation += 0.5 * spheres_.place[i].mass * velocity(i).squaredNorm();
    energies.rotation += 0.5 * spheres_.inertia(i) * spin(i).squaredNorm();
    energies.potential -= spheres_.place[i].mass * rules_.gravity.dot(spheres_.place[i].centre());
  }
  for (const state::Clump& clump : clumps_.clumps) {
    const ClumpEnergies of = engine::energies(clump, rules_.gravity, rules_.step);
    energies.translation += of.translation;
    energies.rotation += of.rotation;
    energies.potential += of.potential;
  }
  energies.elastic = sums_.elastic;
  energies.sliding = sums_.sliding;
  energies.dashpot_work = sums_.dashpot_work;
  energies.sliding_work = sums_.sliding_work - sums_.sliding;
  energies.wall_work = wall_work_;
  energies.bonds = sums_.bonds;
  energies.bond_drag = sums_.bond_drag;
  energies.fracture = sums_.fracture;
  return energies;
}

Vector3 SphereStepper::momentum() const {
  Vector3 total = Vector3::Zero();
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    if (!is_member(i)) total += spheres_.place[i].mass * velocity(i);
  for (const state::Clump& clump : clumps_.clumps) total += clump.mass * engine::velocity(clump, rules_.gravity, rules_.step);
  return total;
}

Vector3 SphereStepper::angular_momentum() const {
  Vector3 total = Vector3::Zero();
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    if (!is_member(i))
      total += spheres_.place[i].mass * spheres_.place[i].centre().cross(velocity(i)) + spheres_.inertia(i) * spin(i);
  for (const state::Clump& clump : clumps_.clumps) total += engine::angular_momentum(clump, rules_.gravity, rules_.step);
  return total;
}

}  // namespace sazare::engine
