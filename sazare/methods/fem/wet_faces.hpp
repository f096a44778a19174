#pragma once

/// Integrals over the part of a face that is under water.

#include "sazare/laws/water/water_pressure.hpp"
#include "sazare/methods/fem/boundary_faces.hpp"
#include "sazare/methods/fem/solids.hpp"

namespace sazare::methods::fem {

/// Points of integration of the part of a face below the level; their weights sum to its measure in the reference element. What
/// is wet of a line, and of a flat face whose opposite sides are parallel or that is a triangle, is found exactly; of other faces
/// that the level cuts, by halving them seven times, with straight cuts in the last parts.
std::vector<QuadraturePoint> wet_points(const geometry::ElementMesh& mesh, const geometry::MeshElement& face,
                                        const laws::WaterPressure& water);

/// Force of the pressure on every node of a face that is seen from outside (see ElementFace), node by node [N].
template <int D>
Eigen::VectorXd pressure_force(const geometry::ElementMesh& mesh, const geometry::MeshElement& face,
                               const laws::WaterPressure& water);

/// Mass of water that moves with a face, across it only, by node and axis [kg]: that of Westergaard for water of this density and
/// depth [kg/m3; m]. Lumped, each node has a block of its own, in proportion to that of the consistent matrix.
template <int D>
Eigen::MatrixXd added_mass(const geometry::ElementMesh& mesh, const geometry::MeshElement& face, const laws::WaterPressure& water,
                           Real density, Real water_depth, MassMatrix kind);

}  // namespace sazare::methods::fem
