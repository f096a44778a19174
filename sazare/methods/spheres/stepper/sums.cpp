/// What spheres have at the time of the forces kept, and what all hold together.

#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::methods::spheres {

Vector3 SphereStepper::acceleration(std::size_t sphere) const {
  const state::SphereLoad load = levels_.load(sphere);
  const Real inverse = spheres_.kick[sphere].inverse_mass;
  return inverse * Vector3(load.fx, load.fy, load.fz) + (inverse > 0 ? rules_.gravity : Vector3(Vector3::Zero()));
}

state::SphereLoad SphereStepper::load(std::size_t sphere) const {
  state::SphereLoad load = levels_.load(sphere);
  if (water_.empty() || !(spheres_.kick[sphere].inverse_mass > 0)) return load;
  const Vector3 back = water_.added_mass(spheres_.number[sphere]) * rules_.gravity;  // see WaterForces
  load.fx += back.x();
  load.fy += back.y();
  load.fz += back.z();
  return load;
}

/// What the velocity of a single sphere lacks at `time()`.
Vector3 SphereStepper::half_kick(std::size_t sphere) const {
  const state::SphereLoad impulse = levels_.half_impulse(sphere);
  const Real inverse = spheres_.kick[sphere].inverse_mass;
  return inverse * Vector3(impulse.fx, impulse.fy, impulse.fz) +
         (inverse > 0 ? 0.5 * levels_.step(levels_.active_level(sphere)) * rules_.gravity : Vector3(Vector3::Zero()));
}

Vector3 SphereStepper::half_turning_kick(std::size_t sphere) const {
  const state::SphereLoad impulse = levels_.half_impulse(sphere);
  return spheres_.kick[sphere].inverse_inertia * Vector3(impulse.mx, impulse.my, impulse.mz);
}

Vector3 SphereStepper::velocity(std::size_t sphere) const {
  if (is_member(sphere)) return spheres_.place[sphere].velocity();
  const state::SphereKick& kick = spheres_.kick[sphere];
  return Vector3(kick.vx, kick.vy, kick.vz) + half_kick(sphere);
}

Vector3 SphereStepper::spin(std::size_t sphere) const {
  if (is_member(sphere)) return spheres_.spin[sphere].spin();
  const state::SphereKick& kick = spheres_.kick[sphere];
  return Vector3(kick.wx, kick.wy, kick.wz) + half_turning_kick(sphere);
}

SphereEnergies SphereStepper::energies() const {
  SphereEnergies energies;
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    if (!(spheres_.kick[i].inverse_mass > 0)) continue;
    energies.translation += 0.5 * spheres_.place[i].mass * velocity(i).squaredNorm();
    energies.rotation += 0.5 * spheres_.inertia(i) * spin(i).squaredNorm();
    energies.potential -= spheres_.place[i].mass * rules_.gravity.dot(spheres_.place[i].centre());
  }
  for (const state::Clump& clump : clumps_.clumps) {
    const ClumpEnergies of = methods::spheres::energies(clump, rules_.gravity);
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
  energies.water_work = sums_.water_work - 0.5 * water_work_now_ + sums_.carried_energy - carried_energy();
  energies.applied_work = sums_.applied_work - 0.5 * applied_work_now_;
  return energies;
}

/// Kinetic energy of the water that single spheres and clumps carry along [J].
Real SphereStepper::carried_energy() const {
  if (water_.empty()) return 0;
  Real twice = 0;
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    if (spheres_.kick[i].inverse_mass > 0) twice += water_.added_mass(spheres_.number[i]) * velocity(i).squaredNorm();
  for (const state::Clump& clump : clumps_.clumps) twice += clump.added_mass * methods::spheres::velocity(clump).squaredNorm();
  return 0.5 * twice;
}

Vector3 SphereStepper::momentum() const {
  Vector3 total = Vector3::Zero();
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    if (!is_member(i)) total += spheres_.place[i].mass * velocity(i);
  for (const state::Clump& clump : clumps_.clumps) total += clump.mass * methods::spheres::velocity(clump);
  return total;
}

Vector3 SphereStepper::angular_momentum() const {
  Vector3 total = Vector3::Zero();
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    if (!is_member(i))
      total += spheres_.place[i].mass * spheres_.place[i].centre().cross(velocity(i)) + spheres_.inertia(i) * spin(i);
  for (const state::Clump& clump : clumps_.clumps) total += methods::spheres::angular_momentum(clump);
  return total;
}

}  // namespace sazare::methods::spheres
