#include "sazare/methods/fem/boundary_faces.hpp"

namespace sazare::methods::fem {

template <int D>
FacePoint<D> face_point(const geometry::ElementMesh& mesh, const geometry::MeshElement& face, const QuadraturePoint& point) {
  const NodeGradients slopes = shape_gradients(face.shape, point.place);
  Vector3 first = Vector3::Zero(), second = Vector3::Zero();
  for (std::size_t i = 0; i < face.node_list().size(); ++i) {
    const Vector3& place = mesh.nodes[static_cast<std::size_t>(face.nodes[i])];
    first += slopes(static_cast<Eigen::Index>(i), 0) * place;
    second += slopes(static_cast<Eigen::Index>(i), 1) * place;
  }
  const Vector3 across = D == 2 ? Vector3(first.y(), -first.x(), 0) : Vector3(first.cross(second));
  return {shape_values(face.shape, point.place), across.normalized().template head<D>(), across.norm() * point.weight};
}

template <int D>
Eigen::MatrixXd face_impedance(const geometry::ElementMesh& mesh, const geometry::MeshElement& face, Real across, Real along) {
  const auto nodes = static_cast<Eigen::Index>(face.node_list().size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(nodes * D, nodes * D);
  for (const QuadraturePoint& place : mass_points(face.shape)) {
    const FacePoint<D> point = face_point<D>(mesh, face, place);
    const Eigen::Matrix<Real, D, D> normal = point.normal * point.normal.transpose();
    const Eigen::Matrix<Real, D, D> impedance = along * Eigen::Matrix<Real, D, D>::Identity() + (across - along) * normal;
    for (Eigen::Index a = 0; a < nodes; ++a)
      for (Eigen::Index b = 0; b < nodes; ++b)
        result.template block<D, D>(a * D, b * D) += point.weight * point.values[a] * point.values[b] * impedance;
  }
  return result;
}

std::span<const QuadraturePoint> traction_points(geometry::ElementShape face, Integration integration) {
  return facts(face).simplex ? mass_points(face) : stiffness_points(face, integration);
}

Vector3 place_on(const geometry::ElementMesh& mesh, const geometry::MeshElement& face, const NodeValues& values) {
  Vector3 place = Vector3::Zero();
  for (std::size_t i = 0; i < face.node_list().size(); ++i)
    place += values[static_cast<Eigen::Index>(i)] * mesh.nodes[at(face.nodes[i])];
  return place;
}

NodeValues face_shares(const geometry::ElementMesh& mesh, const geometry::MeshElement& face) {
  NodeValues shares = NodeValues::Zero(static_cast<Eigen::Index>(face.node_list().size()));
  for (const QuadraturePoint& place : mass_points(face.shape)) {
    const Real weight = mesh.dimension == 2 ? face_point<2>(mesh, face, place).weight : face_point<3>(mesh, face, place).weight;
    shares += weight * shape_values(face.shape, place.place);
  }
  return shares;
}

template FacePoint<2> face_point<2>(const geometry::ElementMesh&, const geometry::MeshElement&, const QuadraturePoint&);
template FacePoint<3> face_point<3>(const geometry::ElementMesh&, const geometry::MeshElement&, const QuadraturePoint&);
template Eigen::MatrixXd face_impedance<2>(const geometry::ElementMesh&, const geometry::MeshElement&, Real, Real);
template Eigen::MatrixXd face_impedance<3>(const geometry::ElementMesh&, const geometry::MeshElement&, Real, Real);

}  // namespace sazare::methods::fem
