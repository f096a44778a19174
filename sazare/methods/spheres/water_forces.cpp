#include "sazare/methods/spheres/water_forces.hpp"

#include <cmath>

namespace sazare::methods::spheres {

/// A sphere that moves on its own takes an added mass with it. Returns the kinetic energy of the water that it now carries and did
/// not before [J].
Real WaterForces::carry(state::Spheres& spheres, std::size_t place, Real added_mass) {
  Real& before = added_mass_[static_cast<std::size_t>(spheres.number[place])];
  Real gained = 0;
  if (Real& inverse = spheres.kick[place].inverse_mass; inverse > 0) {
    gained = 0.5 * (added_mass - before) * spheres.place[place].velocity().squaredNorm();
    inverse = 1 / (spheres.place[place].mass + added_mass);
  }
  before = added_mass;
  return gained;
}

Real WaterForces::largest_steady_speed(Index number, Real density) const {
  constexpr Real least_drag = 0.44;  // of a smooth sphere
  const laws::BodyInWater& body = bodies_[static_cast<std::size_t>(number)];
  const Real weight = std::abs(density - water_.density) * body.volume * water_.gravity;
  return std::sqrt(weight / (0.5 * water_.density * body.drag_coefficient.value_or(least_drag) * body.area));
}

ContactSums WaterForces::evaluate(state::Spheres& spheres, const BodyLoadTask& task) {
  ContactSums sums;
  for (std::size_t i = task.begin; i < task.end; ++i) {
    const Index number = spheres.number[i];
    if (!task.has(number)) continue;
    const Vector3 velocity = spheres.place[i].velocity();
    const laws::WaterLoad load = laws::water_load(bodies_[static_cast<std::size_t>(number)], spheres.place[i].centre(), velocity,
                                                  stands_ ? still_ : water_, task.time);
    sums.carried_energy += carry(spheres, i, load.added_mass);
    sums.water_work += task.step * load.force.dot(velocity);
    // Gravity acts on the mass of the body alone: what the kick gives the added mass is taken back.
    const bool is_single = spheres.kick[i].inverse_mass > 0;
    task.add(i, load.force + (is_single ? load.added_mass * water_.gravity : 0) * water_.up);
  }
  return sums;
}

}  // namespace sazare::methods::spheres
