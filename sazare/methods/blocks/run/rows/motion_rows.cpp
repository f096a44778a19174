#include "sazare/methods/blocks/run/rows/motion_rows.hpp"

namespace sazare::runs {

void read_bodies(const levels::Simulation<3>& simulation, MotionTable& table) {
  const levels::Snapshot<3> now = simulation.snapshot();
  const std::vector<Vector3> forces = simulation.forces();
  table.resize(now.pose.size());
  for (std::size_t i = 0; i < now.pose.size(); ++i) {
    table.position[i] = now.pose[i].position;
    table.velocity[i] = now.velocity[i];
    table.force[i] = forces[i];
  }
}

}  // namespace sazare::runs
