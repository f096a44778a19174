#include "sazare/methods/spheres/run/motion_rows.hpp"

namespace sazare::runs {

void read_spheres(methods::spheres::SphereStepper& stepper, MotionTable& table) {
  const bool has_forces = stepper.has_begun();
  if (has_forces) stepper.evaluate_now();
  const state::Spheres& spheres = stepper.spheres();
  table.resize(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto number = static_cast<std::size_t>(spheres.number[i]);
    const state::SphereLoad load = has_forces ? stepper.load(i) : state::SphereLoad{};
    const bool falls = spheres.kick[i].inverse_mass > 0;
    table.position[number] = spheres.place[i].centre();
    table.velocity[number] = has_forces ? stepper.velocity(i) : spheres.place[i].velocity();
    table.force[number] = Vector3(load.fx, load.fy, load.fz);
    if (falls) table.force[number] += spheres.place[i].mass * stepper.rules().gravity;
  }
}

}  // namespace sazare::runs
