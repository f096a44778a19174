#include "tests/properties/slab.hpp"

#include "sazare/geometry/gmsh/reader.hpp"

namespace sazare::test {

namespace {

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// True faces that are as stiff as the joints were.
void touch_by_faces(cases::BlocksCase& blocks) {
  blocks.contact.shape = cases::ContactShape::faces;
  blocks.contact.face_stiffness = *blocks.joints[0].normal_stiffness;
  blocks.contact.face_damping = blocks.joints[0].normal_damping;
}

/// Rock of which Young's modulus and Poisson's ratio are given.
void take_springs_from_elements(cases::BlocksCase& blocks) {
  blocks.materials[0].youngs_modulus = 20e9;
  blocks.materials[0].poisson_ratio = 0.2;
  cases::Joint& joint = blocks.joints[0];
  joint.normal_stiffness = joint.shear_stiffness = std::nullopt;
  joint.normal_damping = joint.shear_damping = 0;
  joint.damping_ratio = 0.1;
  joint.law = cases::JointLawName::mixed_mode;
  joint.tensile_strength = 4e6;
  joint.law_parameters = {1000.0, std::nullopt};
  blocks.boundaries = {{"left", cases::BoundaryKind::absorbing}, {"bottom", cases::BoundaryKind::fixed}};
}

}  // namespace

runs::BlocksModel slab(const SlabRules& rules) {
  auto blocks = blast_case();
  blocks.blasts[0].pressure = cases::PressureTable{{}, {0, 1e-3}, {1.5e9, 1.5e9}};
  blocks.time.limiter = rules.limiter;
  blocks.time.levels = rules.levels;
  if (rules.contact == cases::ContactShape::faces) touch_by_faces(blocks);
  if (rules.takes_springs_from_elements || rules.deformable) take_springs_from_elements(blocks);
  blocks.materials[0].deformable = rules.deformable;
  if (rules.limiter == cases::Limiter::travel) {
    blocks.time.base_step = 2e-8;
    blocks.time.travel_length = 2e-7;
  }
  return runs::build_blocks(blocks, geometry::read_gmsh("cases/free-face-blast/slab.msh", 1.0));
}

std::string fingerprint(const runs::BlocksModel& model) {
  const auto& simulation = *model.simulation;
  std::string bytes;
  for (Index body = 0; body < simulation.bodies().size(); ++body) {
    const auto& motion = simulation.bodies().motion[static_cast<std::size_t>(body)];
    for (int i = 0; i < 3; ++i) {
      append(bytes, motion.position[i]);
      append(bytes, motion.velocity[i]);
      append(bytes, motion.angular_momentum[i]);
      for (int j = 0; j < 3; ++j) append(bytes, motion.rotation(i, j));
    }
    if (!simulation.bodies().strain.empty()) append(bytes, simulation.bodies().strain[static_cast<std::size_t>(body)]);
    append(bytes, simulation.levels().level(body));
  }
  for (Index joint = 0; joint < model.joints->count(); ++joint) append(bytes, model.joints->state(joint));
  for (const Real joules : simulation.energy_balance().joules) append(bytes, joules);
  append(bytes, simulation.now().tick);
  append(bytes, simulation.counters().kicks);
  append(bytes, simulation.counters().pair_evaluations);
  append(bytes, model.contacts->pair_count());
  return bytes;
}

void advance(runs::BlocksModel& model, int base_steps) {
  for (int step = 0; step < base_steps; ++step) model.simulation->advance();
}

std::pair<int, int> levels_in_use(const runs::BlocksModel& model) {
  int lowest = schedule::deepest_level, highest = 0;
  for (Index body = 0; body < model.simulation->bodies().size(); ++body) {
    lowest = std::min(lowest, model.simulation->levels().level(body));
    highest = std::max(highest, model.simulation->levels().level(body));
  }
  return {lowest, highest};
}

}  // namespace sazare::test
