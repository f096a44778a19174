#pragma once

/// Integrals over faces of the body: tractions and viscous boundaries.

#include "sazare/geometry/element_mesh.hpp"
#include "sazare/methods/fem/node_pattern.hpp"
#include "sazare/methods/fem/shape_functions.hpp"

namespace sazare::methods::fem {

template <int D>
struct FacePoint {
  NodeValues values;
  Vector<D> normal = Vector<D>::Zero();  ///< unit; as the face's nodes turn, see ElementFace
  Real weight = 0;                       ///< area (in 2-D length) [m2; m]
};

template <int D>
FacePoint<D> face_point(const geometry::ElementMesh& mesh, const geometry::MeshElement& face, const QuadraturePoint& point);

/// Where tractions on a face are integrated that the stress beyond it gives: as densely as the stiffness of elements beside it.
std::span<const QuadraturePoint> traction_points(geometry::ElementShape face, Integration integration);

/// The place of a point of a face with these shape functions [m].
Vector3 place_on(const geometry::ElementMesh& mesh, const geometry::MeshElement& face, const NodeValues& values);

/// Impedance of the ground beyond a face: rate of force by velocity of its nodes [N s/m]. Density times the velocity of waves,
/// P across the face and S along it. Lysmer and Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969) 859-877.
template <int D>
Eigen::MatrixXd face_impedance(const geometry::ElementMesh& mesh, const geometry::MeshElement& face, Real across, Real along);

/// Area that belongs to each node of a face: the integrals of its shape functions [m2; m in 2-D].
NodeValues face_shares(const geometry::ElementMesh& mesh, const geometry::MeshElement& face);

}  // namespace sazare::methods::fem
