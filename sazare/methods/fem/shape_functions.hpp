#pragma once

/// Shape functions of the elements, and the points at which they are integrated.

#include "sazare/geometry/element_shape.hpp"

namespace sazare::methods::fem {

inline constexpr int most_nodes = geometry::most_element_nodes;

using NodeValues = Eigen::Matrix<Real, Eigen::Dynamic, 1, 0, most_nodes, 1>;
using NodeGradients = Eigen::Matrix<Real, Eigen::Dynamic, 3, 0, most_nodes, 3>;

/// N of every node at a place [-].
NodeValues shape_values(geometry::ElementShape shape, const Vector3& place);

/// Derivatives of N by the reference coordinates.
NodeGradients shape_gradients(geometry::ElementShape shape, const Vector3& place);

struct QuadraturePoint {
  Vector3 place = Vector3::Zero();  ///< reference coordinates
  Real weight = 0;                  ///< the weights sum to the measure of the reference element
};

enum class Integration { full, reduced };

/// For the stiffness. Full integration is exact for elements whose sides are straight and middles in the middle (parallel sides
/// for quadrilaterals and hexahedra). Reduced integration, of 3-node lines, 8-node quadrilaterals and 20-node hexahedra only,
/// takes Gauss's points of the linear element: softer, and without locking where the volume hardly changes.
std::span<const QuadraturePoint> stiffness_points(geometry::ElementShape shape, Integration integration);

/// For the mass and for tractions: products of two shape functions.
std::span<const QuadraturePoint> mass_points(geometry::ElementShape shape);

/// For joints: at the nodes where the shape allows, so that pressures do not oscillate from node to node.
std::span<const QuadraturePoint> nodal_points(geometry::ElementShape shape);

}  // namespace sazare::methods::fem
