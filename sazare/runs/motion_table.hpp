#pragma once

/// The motion of all bodies of a run at one time, for readers outside: rows in the order in which the run writes its snapshots.

#include <vector>

#include "sazare/core/links.hpp"
#include "sazare/core/vector.hpp"

namespace sazare::engine {
template <int D>
class Simulation;
template <int D>
class UniformStepper;
class SphereStepper;
template <int D>
class FemStepper;
}  // namespace sazare::engine

namespace sazare::runs {

struct MotionTable {
  std::vector<Vector3> position;  ///< of the centre [m]; in the plane z is 0
  std::vector<Vector3> velocity;  ///< [m/s]
  std::vector<Vector3> force;     ///< all of it, gravity too [N]; in the plane [N/m]

  /// The rows stay where they are in memory as long as their number stays.
  void resize(std::size_t bodies) {
    for (auto* rows : {&position, &velocity, &force}) rows->assign(bodies, Vector3::Zero());
  }
};

/// Elements of method blocks, at a base step.
void read_bodies(const engine::Simulation<3>& simulation, MotionTable& table);

/// The first `count` particles; elements of rectangles stand before their supports.
template <int D>
void read_particles(const engine::UniformStepper<D>& stepper, Index count, MotionTable& table);

/// By number of the sphere, whatever their order in memory. Evaluates the forces, which the next step takes over.
void read_spheres(engine::SphereStepper& stepper, MotionTable& table);

/// Nodes of finite elements.
template <int D>
void read_nodes(const engine::FemStepper<D>& stepper, MotionTable& table);

extern template void read_particles(const engine::UniformStepper<2>&, Index, MotionTable&);
extern template void read_particles(const engine::UniformStepper<3>&, Index, MotionTable&);
extern template void read_nodes(const engine::FemStepper<2>&, MotionTable&);
extern template void read_nodes(const engine::FemStepper<3>&, MotionTable&);

}  // namespace sazare::runs
