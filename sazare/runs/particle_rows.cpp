#include "sazare/runs/particle_rows.hpp"

namespace sazare::runs {

template <int D>
void read_particles(const particles::UniformStepper<D>& stepper, Index count, MotionTable& table) {
  const auto bodies = static_cast<std::size_t>(count);
  const auto& rows = stepper.particles();
  const auto velocity = stepper.velocity(), acceleration = stepper.acceleration();
  table.resize(bodies);
  for (std::size_t axis = 0; axis < D; ++axis) {
    const auto row = static_cast<Eigen::Index>(axis);
    for (std::size_t i = 0; i < bodies; ++i) {
      table.position[i][row] = rows.position(axis, i);
      table.velocity[i][row] = velocity[axis][i];
      table.force[i][row] = rows.inverse_mass[i] > 0 ? acceleration[axis][i] / rows.inverse_mass[i] : 0;
    }
  }
}

template void read_particles(const particles::UniformStepper<2>&, Index, MotionTable&);
template void read_particles(const particles::UniformStepper<3>&, Index, MotionTable&);

}  // namespace sazare::runs
