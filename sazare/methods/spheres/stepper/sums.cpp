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

SphereEnergies energies_of(const WorkSums& works, const MotionEnergies& motion) {
  const auto without_half_of_now = [](const ExactSum& twice, const ExactSum& now) { return 0.5 * (twice.value() - now.value()); };
  SphereEnergies energies;
  energies.translation = motion.translation.value();
  energies.rotation = motion.rotation.value();
  energies.potential = motion.potential.value();
  energies.elastic = works.elastic.value();
  energies.sliding = works.sliding.value();
  energies.dashpot_work = works.dashpot_work.value();
  energies.sliding_work = works.sliding_work.value() - energies.sliding;
  energies.wall_work = works.wall_work.value();
  energies.bonds = works.bonds.value();
  energies.bond_drag = works.bond_drag.value();
  energies.fracture = works.fracture.value();
  energies.water_work =
      without_half_of_now(works.twice_water_work, works.water_work_now) + works.carried_energy.value() - motion.carried.value();
  energies.applied_work = without_half_of_now(works.twice_applied_work, works.applied_work_now);
  return energies;
}

void SphereStepper::add_energies(std::size_t sphere, MotionEnergies& sums) const {
  if (!(spheres_.kick[sphere].inverse_mass > 0)) return;
  const state::SpherePlace& place = spheres_.place[sphere];
  const Real square = velocity(sphere).squaredNorm();
  sums.translation += 0.5 * place.mass * square;
  sums.rotation += 0.5 * spheres_.inertia(sphere) * spin(sphere).squaredNorm();
  sums.potential -= place.mass * rules_.gravity.dot(place.centre());
  if (!water_.empty()) sums.carried += 0.5 * water_.added_mass(spheres_.number[sphere]) * square;
}

void SphereStepper::add_energies(const state::Clump& clump, MotionEnergies& sums) const {
  const ClumpEnergies of = methods::spheres::energies(clump, rules_.gravity);
  sums.translation += of.translation;
  sums.rotation += of.rotation;
  sums.potential += of.potential;
  if (!water_.empty()) sums.carried += 0.5 * clump.added_mass * methods::spheres::velocity(clump).squaredNorm();
}

MotionEnergies SphereStepper::motion_energies() const {
  auto sums = sum_own<MotionEnergies>([this](std::size_t i, MotionEnergies& part) { add_energies(i, part); });
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c)
    if (owns_clump(c)) add_energies(clumps_.clumps[c], sums);
  return sums;
}

void SphereStepper::add_momenta(std::size_t sphere, Momenta& sums) const {
  if (is_member(sphere)) return;
  const state::SpherePlace& place = spheres_.place[sphere];
  const Vector3 momentum = place.mass * velocity(sphere);
  sums.linear += momentum;
  sums.angular += Vector3(place.centre().cross(momentum) + spheres_.inertia(sphere) * spin(sphere));
}

Momenta SphereStepper::momenta() const {
  auto sums = sum_own<Momenta>([this](std::size_t i, Momenta& part) { add_momenta(i, part); });
  for (std::size_t c = 0; c < clumps_.clumps.size(); ++c) {
    if (!owns_clump(c)) continue;
    const state::Clump& clump = clumps_.clumps[c];
    sums.linear += Vector3(clump.mass * methods::spheres::velocity(clump));
    sums.angular += methods::spheres::angular_momentum(clump);
  }
  return sums;
}

}  // namespace sazare::methods::spheres
