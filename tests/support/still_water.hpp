#pragma once

/// Still water on groups of faces for tests.

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/wet_faces.hpp"
#include "tests/support/element_boxes.hpp"

namespace sazare::test {

inline constexpr Real water_density = 1000, gravity = 9.81, unit_weight = water_density * gravity;

inline laws::WaterPressure water_at(Real level, int dimension) { return {unit_weight, dimension - 1, level}; }

/// Adds the pressure of a water on a group of faces.
template <int D>
void press(const geometry::ElementMesh& mesh, const std::string& group, const laws::WaterPressure& water,
           methods::fem::StillWater<D>& made) {
  made.pressure.force.resize(mesh.nodes.size() * D, 0);
  for (const auto& face : mesh.find_group(group)->elements) {
    const Eigen::VectorXd force = methods::fem::pressure_force<D>(mesh, face, water);
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      made.pressure.force[methods::fem::number<D>(face.nodes[static_cast<std::size_t>(i / D)], static_cast<int>(i % D))] +=
          force[i];
      made.force[static_cast<int>(i % D)] += force[i];
    }
  }
}

}  // namespace sazare::test
