#pragma once

/// Small scenes of blocks for tests: meshes written down by hand and the concrete of the blasting paper.

#include "sazare/methods/blocks/case/case.hpp"
#include "sazare/methods/blocks/run/model.hpp"

namespace sazare::test {

inline void run(runs::BlocksModel& model, int base_steps) {
  for (int step = 0; step < base_steps; ++step) model.simulation->advance();
}

/// Momentum [kg m/s] and moment of momentum about the origin [kg m2/s] of all bodies.
struct Momenta {
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
};

inline Momenta momenta_of(const runs::BlocksModel& model) {
  const auto& bodies = model.simulation->bodies();
  Momenta sum;
  for (std::size_t body = 0; body < bodies.motion.size(); ++body) {
    const auto& motion = bodies.motion[body];
    const Vector3 own = bodies.inertia[body].mass * motion.velocity;
    sum.linear += own;
    sum.angular += motion.angular_momentum + state::pose_at(motion, model.simulation->now()).position.cross(own);
  }
  return sum;
}

/// Two tetrahedra, mirror images in the plane x = 0, that share the triangle in it. Element 0 lies at x < 0.
inline geometry::TetraMesh two_blocks(Real size = 0.1) {
  geometry::TetraMesh mesh;
  const Real half = 0.5 * size, low = -size / std::sqrt(12.0), high = size / std::sqrt(3.0), tall = size * std::sqrt(2.0 / 3);
  mesh.nodes = {{0, -half, low}, {0, half, low}, {0, 0, high}, {-tall, 0, 0}, {tall, 0, 0}};
  mesh.tetrahedra = {{3, 0, 1, 2}, {4, 0, 2, 1}};
  mesh.region = {0, 1};
  mesh.region_names = {"left", "right"};
  return mesh;
}

inline cases::Joint concrete_joint(const std::string& first, const std::string& second) {
  cases::Joint joint;
  joint.name = first + " " + second;
  joint.between = {first, second};
  joint.normal_stiffness = 450e9;
  joint.shear_stiffness = 90e9;
  joint.normal_damping = 22.6e6;
  joint.shear_damping = 10.1e6;
  joint.cohesion = 6.66e6;
  joint.friction_coefficient = 0.58;
  joint.tensile_strength = 6.66e6;
  joint.fracture_energy = 99.67;
  return joint;
}

/// The two blocks as concrete, free in space, with a joint between them that is bonded or not.
inline cases::BlocksCase two_block_case(bool bonded) {
  cases::BlocksCase blocks;
  blocks.materials = {{"left", {"left"}, 2390.0}, {"right", {"right"}, 2390.0}};
  cases::Joint joint = concrete_joint("left", "right");
  joint.bonded = bonded;
  blocks.joints = {joint};
  blocks.contact.normal_stiffness = 1.5e9;
  blocks.contact.normal_damping = 3.08e6;
  blocks.contact.friction_coefficient = 0.58;
  blocks.time.limiter = cases::Limiter::none;
  blocks.time.base_step = 1e-8;
  blocks.time.history_interval = 1e-6;
  return blocks;
}

/// Rock by its moduli, of the region "rock", that cannot break and has no dashpots.
inline cases::BlocksCase elastic_rock(Real density, Real youngs_modulus, Real poisson_ratio) {
  cases::BlocksCase blocks;
  blocks.materials = {{"rock", {"rock"}, density, youngs_modulus, poisson_ratio}};
  cases::Joint joint = concrete_joint("rock", "rock");
  joint.normal_stiffness = joint.shear_stiffness = std::nullopt;
  joint.normal_damping = joint.shear_damping = 0;
  joint.cohesion = joint.tensile_strength = 1e9;
  joint.fracture_energy = 1e7;
  blocks.joints = {joint};
  blocks.contact.normal_stiffness = 1e9;
  blocks.time.history_interval = 1e-5;
  return blocks;
}

inline void move(cases::BlocksCase& blocks, const std::string& region, const Vector3& velocity) {
  blocks.initial_velocities.push_back({{region}, velocity});
}

/// A bar of cubes of six blocks each, along x; the first cubes are the region "head", its far end the surface "end".
inline geometry::TetraMesh cube_bar(int cubes, Real size, int head) {
  geometry::TetraMesh mesh;
  const auto node = [](int i, int j, int k) { return 4 * i + 2 * j + k; };
  for (int i = 0; i <= cubes; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) mesh.nodes.push_back(size * Vector3(i, j, k));
  // Six blocks about the long diagonal: between them, a walk round the other six corners.
  constexpr std::array<std::array<int, 3>, 6> round = {{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {1, 0, 1}}};
  for (int i = 0; i < cubes; ++i)
    for (std::size_t side = 0; side < 6; ++side) {
      const auto &a = round[side], &b = round[(side + 1) % 6];
      mesh.tetrahedra.push_back({node(i, 0, 0), node(i + a[0], a[1], a[2]), node(i + b[0], b[1], b[2]), node(i + 1, 1, 1)});
      mesh.region.push_back(i < head ? 0 : 1);
    }
  mesh.region_names = {"head", "rest"};
  mesh.surfaces.push_back(
      {"end",
       {{node(cubes, 0, 0), node(cubes, 1, 0), node(cubes, 1, 1)}, {node(cubes, 0, 0), node(cubes, 1, 1), node(cubes, 0, 1)}}});
  return mesh;
}

/// Roughly the speed of a wave along the bar below [m/s].
inline constexpr Real bar_speed = 1300;

/// A bar that cannot break and has no dashpots, its head in motion along it.
inline cases::BlocksCase bar_case() {
  cases::BlocksCase blocks;
  blocks.materials = {{"concrete", {"head", "rest"}, 2390.0}};
  cases::Joint joint = concrete_joint("concrete", "concrete");
  joint.normal_damping = joint.shear_damping = 0;
  joint.cohesion = joint.tensile_strength = 1e9;
  joint.fracture_energy = 1e7;
  blocks.joints = {joint};
  blocks.contact.normal_stiffness = 1e9;
  blocks.initial_velocities = {{{"head"}, {0.01, 0, 0}}};
  blocks.time.history_interval = 1e-6;
  return blocks;
}

/// The scene of the paper with the limits given; the mesh is read from the repository's root.
inline cases::BlocksCase blast_case() {
  cases::BlocksCase blocks;
  blocks.materials = {{"concrete", {"concrete"}, 2390.0}};
  blocks.joints = {concrete_joint("concrete", "concrete")};
  blocks.contact.normal_stiffness = 1.5e9;
  blocks.contact.normal_damping = 3.08e6;
  blocks.contact.friction_coefficient = 0.58;
  cases::Blast blast;
  blast.name = blast.surface = "hole";
  blast.pressure = cases::PressurePulse{5.75e8, 1.33e-4, 2.75};
  blocks.blasts = {blast};
  cases::Constraint in_plane;
  in_plane.regions = {"concrete"};
  in_plane.translation = {false, false, true};
  blocks.constraints = {in_plane};
  blocks.time.history_interval = 1e-6;
  return blocks;
}

}  // namespace sazare::test
