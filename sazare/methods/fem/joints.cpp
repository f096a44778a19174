#include "sazare/methods/fem/joints.hpp"

#include <algorithm>

#include "sazare/methods/fem/boundary_faces.hpp"

namespace sazare::methods::fem {

template <int D>
Joints<D>::Joints(const geometry::ElementMesh& mesh, std::vector<JointSet> sets) : sets_(std::move(sets)) {
  for (std::size_t set = 0; set < sets_.size(); ++set)
    for (std::size_t face = 0; face < sets_[set].faces.size(); ++face) {
      const geometry::MeshElement& first = sets_[set].faces[face].first;
      const auto places = nodal_points(first.shape);
      joint_.push_back({set, face, point_.size(), places.size()});
      for (const QuadraturePoint& place : places) {
        const FacePoint<D> at = face_point<D>(mesh, first, place);
        point_.push_back({at.values, at.normal, at.weight});
      }
    }
}

template <int D>
std::vector<Index> Joints<D>::nodes(std::size_t number) const {
  const geometry::InterfaceFace& face = sets_[joint_[number].set].faces[joint_[number].face];
  const auto first = face.first.node_list(), second = face.second.node_list();
  std::vector<Index> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  return all;
}

template <int D>
Vector<D> Joints<D>::opening(const Joint& joint, const Point& point, const NodalColumn& displacement) const {
  const geometry::InterfaceFace& face = sets_[joint.set].faces[joint.face];
  const auto first = face.first.node_list(), second = face.second.node_list();
  Vector<D> sum = Vector<D>::Zero();
  for (std::size_t i = 0; i < first.size(); ++i)
    for (int axis = 0; axis < D; ++axis) {
      const auto of = [&](Index node) { return displacement[static_cast<std::size_t>(node * D + axis)]; };
      sum[axis] += point.values[static_cast<Eigen::Index>(i)] * (of(second[i]) - of(first[i]));
    }
  return sum;
}

template <int D>
laws::InterfaceResponse<D> Joints<D>::response(const Joint& joint, std::size_t point, const NodalColumn& displacement,
                                               std::span<const Real> memory) const {
  const Vector<D> slip = Eigen::Map<const Vector<D>>(memory.data() + point * D);
  return laws::respond<D>(sets_[joint.set].law, opening(joint, point_[point], displacement), point_[point].normal, slip);
}

template <int D>
bool Joints<D>::evaluate(std::size_t number, const NodalColumn& displacement, std::span<const Real> before, std::span<Real> after,
                         std::span<Real> force, std::span<Real> tangent) const {
  const Joint& joint = joint_[number];
  const auto half = static_cast<Eigen::Index>(force.size()) / 2;
  using RowMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<Eigen::VectorXd> f(force.data(), 2 * half);
  Eigen::Map<RowMatrix> k(tangent.data(), tangent.empty() ? 0 : 2 * half, tangent.empty() ? 0 : 2 * half);
  f.setZero();
  k.setZero();
  bool changes = false;
  for (std::size_t p = joint.first_point; p < joint.first_point + joint.points; ++p) {
    const auto found = response(joint, p, displacement, before);
    changes = changes || found.state != laws::InterfaceState::sticks;
    Eigen::Map<Vector<D>>(after.data() + p * D) = found.slip;
    const Point& point = point_[p];
    for (Eigen::Index a = 0; a < half / D; ++a) {
      const Vector<D> part = point.weight * point.values[a] * found.force;
      f.template segment<D>(half + a * D) += part;
      f.template segment<D>(a * D) -= part;
      if (tangent.empty()) continue;
      for (Eigen::Index b = 0; b < half / D; ++b) {
        const Eigen::Matrix<Real, D, D> block = point.weight * point.values[a] * point.values[b] * found.tangent;
        k.template block<D, D>(half + a * D, half + b * D) += block;
        k.template block<D, D>(a * D, b * D) += block;
        k.template block<D, D>(half + a * D, b * D) -= block;
        k.template block<D, D>(a * D, half + b * D) -= block;
      }
    }
  }
  return changes;
}

template <int D>
typename Joints<D>::Energies Joints<D>::energies(std::size_t number, const NodalColumn& displacement_before,
                                                 const NodalColumn& displacement, std::span<const Real> before,
                                                 std::span<const Real> after) const {
  const Joint& joint = joint_[number];
  Energies result;
  for (std::size_t p = joint.first_point; p < joint.first_point + joint.points; ++p) {
    // Responses to states that were found already: their memory stays.
    const auto old = response(joint, p, displacement_before, before), now = response(joint, p, displacement, after);
    const Vector<D> slip = Eigen::Map<const Vector<D>>(after.data() + p * D) - Eigen::Map<const Vector<D>>(before.data() + p * D);
    result.elastic += point_[p].weight * now.energy;
    result.friction += 0.5 * point_[p].weight * slip.dot(old.shear + now.shear);
  }
  return result;
}

template <int D>
typename Joints<D>::Summary Joints<D>::summary(std::size_t set, const NodalColumn& displacement,
                                               std::span<const Real> memory) const {
  Summary result;
  Real area = 0;
  for (const Joint& joint : joint_) {
    if (joint.set != set) continue;
    for (std::size_t p = joint.first_point; p < joint.first_point + joint.points; ++p) {
      const auto found = response(joint, p, displacement, memory);
      const Real weight = point_[p].weight;
      const Real limit = sets_[set].law.cohesion - sets_[set].law.friction_coefficient * found.force.dot(point_[p].normal);
      const bool open = found.state == laws::InterfaceState::open;
      area += weight;
      result.open_fraction += open ? weight : 0;
      result.sliding_fraction += !open && found.shear.norm() >= (1 - 1e-9) * limit ? weight : 0;
      result.largest_slip = std::max(result.largest_slip, Eigen::Map<const Vector<D>>(memory.data() + p * D).norm());
      result.force -= weight * found.force;
    }
  }
  if (area > 0) result.open_fraction /= area;
  if (area > 0) result.sliding_fraction /= area;
  return result;
}

template class Joints<2>;
template class Joints<3>;

}  // namespace sazare::methods::fem
