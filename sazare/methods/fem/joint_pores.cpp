#include "sazare/methods/fem/joint_pores.hpp"

#include <map>
#include <set>

#include "sazare/methods/fem/boundary_faces.hpp"

namespace sazare::methods::fem {
namespace {

using FaceName = std::set<Index>;

/// Faces of the elements in which the excess pressure is an unknown.
template <int D>
std::set<FaceName> faces_with_pressures(const geometry::ElementMesh& mesh, const Pores<D>& pores) {
  std::set<FaceName> faces;
  for (std::size_t i = 0; i < pores.size(); ++i) {
    const geometry::MeshElement& element = mesh.elements[at(pores.element(i))];
    for (const geometry::ElementFace& face : geometry::faces_of(element.shape)) {
      FaceName nodes;
      for (const int place : face.nodes) nodes.insert(element.nodes[at(place)]);
      faces.insert(std::move(nodes));
    }
  }
  return faces;
}

}  // namespace

template <int D>
JointPores<D>::JointPores(const geometry::ElementMesh& mesh, const Joints<D>& joints, const Pores<D>& pores) : mesh_(&mesh) {
  if (joints.size() == 0 || pores.size() == 0) return;
  const std::set<FaceName> saturated = faces_with_pressures(mesh, pores);
  std::map<Index, Index> pressure_of;
  for (std::size_t pressure = 0; pressure < pores.pressure_nodes(); ++pressure)
    pressure_of[pores.node_of(pressure)] = pores.pressure_node(pressure);
  for (const JointSet& set : joints.sets())
    for (const geometry::InterfaceFace& face : set.faces) {
      std::vector<Index> nodes, pressures;
      int sides = 0;
      for (const auto& side : {face.first.node_list(), face.second.node_list()}) {
        nodes.insert(nodes.end(), side.begin(), side.end());
        if (!saturated.contains({side.begin(), side.end()})) continue;
        ++sides;
        for (int corner = 0; corner < facts(face.first.shape).corners; ++corner)
          pressures.push_back(pressure_of.at(side[static_cast<std::size_t>(corner)]));
      }
      if (sides == 0) continue;
      nodes.insert(nodes.end(), pressures.begin(), pressures.end());
      groups_.add(nodes);
      face_.push_back({&face, Real{1} / sides});
    }
}

template <int D>
void JointPores<D>::add_coupling(BlockMatrix<D>& matrix) const {
  for (std::size_t i = 0; i < size(); ++i) {
    const geometry::MeshElement& first = face_[i].face->first;
    const auto own = static_cast<Eigen::Index>(first.node_list().size()), all = static_cast<Eigen::Index>(nodes(i).size());
    const Eigen::Index corners = facts(first.shape).corners;
    Eigen::MatrixXd both = Eigen::MatrixXd::Zero(all * D, all * D);
    for (const QuadraturePoint& place : nodal_points(first.shape)) {  // those of the joint's own forces
      const FacePoint<D> point = face_point<D>(*mesh_, first, place);
      const NodeValues values = shape_values(corner_shape(first.shape), place.place);
      for (Eigen::Index pressure = 2 * own; pressure < all; ++pressure)
        for (Eigen::Index node = 0; node < own; ++node)
          for (int axis = 0; axis < D; ++axis) {
            const Real q = pore_impedance * face_[i].share * point.weight * point.values[node] * point.normal[axis] *
                           values[(pressure - 2 * own) % corners];
            const Eigen::Index on_first = node * D + axis, on_second = (own + node) * D + axis;
            both(on_second, pressure * D) -= q;
            both(pressure * D, on_second) += q;
            both(on_first, pressure * D) += q;
            both(pressure * D, on_first) -= q;
          }
    }
    matrix.add(nodes(i), both);
  }
}

template class JointPores<2>;
template class JointPores<3>;

}  // namespace sazare::methods::fem
