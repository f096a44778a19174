#include "sazare/methods/fem/run/motion_rows.hpp"

namespace sazare::runs {

template <int D>
void read_nodes(const methods::fem::FemStepper<D>& stepper, MotionTable& table) {
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

template void read_nodes(const methods::fem::FemStepper<2>&, MotionTable&);
template void read_nodes(const methods::fem::FemStepper<3>&, MotionTable&);

}  // namespace sazare::runs
