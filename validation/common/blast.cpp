#include "validation/common/blast.hpp"

#include <algorithm>
#include <cmath>

#include "sazare/cases/case_file.hpp"
#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/mesh_source.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::validation {

runs::BlocksModel started_blast(const std::vector<std::string>& overrides) {
  const auto file = registry::read_case("cases/free-face-blast/case.toml", overrides);
  auto model = runs::build_blocks(file.as<cases::BlocksCase>(), runs::load_mesh(file, {}, false));
  model.simulation->start();
  return model;
}

void advance_to(runs::BlocksModel& model, Real seconds) {
  const Real half_step = 0.5 * model.simulation->levels().step(0);
  while (model.simulation->now().seconds() < seconds - half_step) model.simulation->advance();
}

std::vector<Vector3> displacements(const runs::BlocksModel& model) {
  std::vector<Vector3> moved;
  const auto snapshot = model.simulation->snapshot();
  for (std::size_t body = 0; body < snapshot.pose.size(); ++body)
    moved.push_back(snapshot.pose[body].position - model.simulation->bodies().start[body]);
  return moved;
}

Real relative_difference(const std::vector<Vector3>& one, const std::vector<Vector3>& other) {
  Real apart = 0, size = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    apart += (one[i] - other[i]).squaredNorm();
    size += other[i].squaredNorm();
  }
  return std::sqrt(apart / size);
}

Real distance_from_hole(const runs::BlocksModel& model, std::size_t element) {
  const Vector3& start = model.simulation->bodies().start[element];
  return std::hypot(start.x() - 1.4, start.y() - 0.6);
}

std::pair<int, int> level_range(const levels::Simulation<3>& simulation) {
  int lowest = schedule::deepest_level, highest = 0;
  for (Index body = 0; body < simulation.bodies().size(); ++body) {
    lowest = std::min(lowest, simulation.levels().level(body));
    highest = std::max(highest, simulation.levels().level(body));
  }
  return {lowest, highest};
}

Momentum momentum(const levels::Simulation<3>& simulation) {
  Momentum sum;
  for (std::size_t body = 0; body < simulation.bodies().motion.size(); ++body) {
    const auto& motion = simulation.bodies().motion[body];
    const Vector3 own = simulation.bodies().inertia[body].mass * motion.velocity;
    sum.linear += own;
    sum.angular += motion.angular_momentum + state::pose_at(motion, simulation.now()).position.cross(own);
  }
  return sum;
}

}  // namespace sazare::validation
