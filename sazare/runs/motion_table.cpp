#include "sazare/runs/motion_table.hpp"

#include "sazare/engine/fem_stepper.hpp"
#include "sazare/engine/simulation.hpp"
#include "sazare/engine/sphere_stepper.hpp"
#include "sazare/engine/uniform_stepper.hpp"

namespace sazare::runs {

void read_bodies(const engine::Simulation<3>& simulation, MotionTable& table) {
  const engine::Snapshot<3> now = simulation.snapshot();
  const std::vector<Vector3> forces = simulation.forces();
  table.resize(now.pose.size());
  for (std::size_t i = 0; i < now.pose.size(); ++i) {
    table.position[i] = now.pose[i].position;
    table.velocity[i] = now.velocity[i];
    table.force[i] = forces[i];
  }
}

template <int D>
void read_particles(const engine::UniformStepper<D>& stepper, Index count, MotionTable& table) {
  const auto bodies = static_cast<std::size_t>(count);
  const auto& particles = stepper.particles();
  const auto velocity = stepper.velocity(), acceleration = stepper.acceleration();
  table.resize(bodies);
  for (std::size_t axis = 0; axis < D; ++axis) {
    const auto row = static_cast<Eigen::Index>(axis);
    for (std::size_t i = 0; i < bodies; ++i) {
      table.position[i][row] = particles.position(axis, i);
      table.velocity[i][row] = velocity[axis][i];
      table.force[i][row] = particles.inverse_mass[i] > 0 ? acceleration[axis][i] / particles.inverse_mass[i] : 0;
    }
  }
}

void read_spheres(engine::SphereStepper& stepper, MotionTable& table) {
  stepper.settle();
  const state::Spheres& spheres = stepper.spheres();
  table.resize(spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto number = static_cast<std::size_t>(spheres.number[i]);
    const state::SphereLoad load = stepper.load(i);
    const bool falls = spheres.kick[i].inverse_mass > 0;
    table.position[number] = spheres.place[i].centre();
    table.velocity[number] = stepper.velocity(i);
    table.force[number] = Vector3(load.fx, load.fy, load.fz);
    if (falls) table.force[number] += spheres.place[i].mass * stepper.rules().gravity;
  }
}

template <int D>
void read_nodes(const engine::FemStepper<D>& stepper, MotionTable& table) {
  const auto& nodes = stepper.body().mesh().nodes;
  const auto& state = stepper.state();
  methods::fem::NodalColumn force(state.acceleration.size(), 0);
  stepper.body().mass().multiply(state.acceleration, 1, force);
  table.resize(nodes.size());
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    table.position[node] = nodes[node];
    for (int axis = 0; axis < D; ++axis) {
      const std::size_t freedom = node * D + static_cast<std::size_t>(axis);
      table.position[node][axis] += state.displacement[freedom];
      table.velocity[node][axis] = state.velocity[freedom];
      table.force[node][axis] = force[freedom];
    }
  }
}

template void read_particles(const engine::UniformStepper<2>&, Index, MotionTable&);
template void read_particles(const engine::UniformStepper<3>&, Index, MotionTable&);
template void read_nodes(const engine::FemStepper<2>&, MotionTable&);
template void read_nodes(const engine::FemStepper<3>&, MotionTable&);

}  // namespace sazare::runs
