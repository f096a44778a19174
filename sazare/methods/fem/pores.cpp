#include "sazare/methods/fem/pores.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace sazare::methods::fem {
namespace {

using geometry::ElementShape;

/// Whether a node of an element is at or above its water table, but for the accuracy of meshes.
bool is_at_table(const geometry::ElementMesh& mesh, const geometry::MeshElement& element, Index node,
                 const laws::WaterPressure& water) {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  for (const Index one : element.node_list()) {
    low = std::min(low, mesh.nodes[at(one)][water.up]);
    high = std::max(high, mesh.nodes[at(one)][water.up]);
  }
  return water.depth(mesh.nodes[at(node)]) <= 0.05 * (high - low);
}

}  // namespace

ElementShape corner_shape(ElementShape shape) {
  switch (shape) {
    case ElementShape::line3:
      return ElementShape::line2;
    case ElementShape::triangle6:
      return ElementShape::triangle3;
    case ElementShape::quadrilateral8:
    case ElementShape::quadrilateral9:
      return ElementShape::quadrilateral4;
    case ElementShape::tetrahedron10:
      return ElementShape::tetrahedron4;
    case ElementShape::hexahedron20:
    case ElementShape::hexahedron27:
      return ElementShape::hexahedron8;
    default:
      return shape;
  }
}

template <int D>
Pores<D>::Pores(const geometry::ElementMesh& mesh, const std::vector<SolidMaterial>& materials, const std::vector<Index>& material)
    : mesh_(&mesh), materials_(&materials), material_(&material) {
  std::map<Index, Index> pressure_of;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& saturation = materials[at(material[e])].saturation;
    if (!saturation || !saturation->flow || saturation->pore_water.depth(centre(mesh, mesh.elements[e])) <= 0) continue;
    const geometry::MeshElement& element = mesh.elements[e];
    std::vector<Index> nodes(element.node_list().begin(), element.node_list().end());
    for (int corner = 0; corner < facts(element.shape).corners; ++corner) {
      const auto [found, is_new] = pressure_of.try_emplace(nodes[at(corner)], static_cast<Index>(node_.size()));
      if (is_new) {
        node_.push_back(nodes[at(corner)]);
        at_rest_.push_back(saturation->pore_water.pressure(mesh.nodes[at(nodes[at(corner)])]));
      }
      nodes.push_back(pressure_node(at(found->second)));
    }
    groups_.add(nodes);
    element_.push_back(static_cast<Index>(e));
  }
  find_drained();
}

/// Water leaves through the table, into dry ground above it and into ground that is drained. Ground without drainage keeps its
/// water at every side.
template <int D>
void Pores<D>::find_drained() {
  std::vector<char> flows(mesh_->nodes.size(), 0), drains(mesh_->nodes.size(), 0);
  for (std::size_t i = 0; i < size(); ++i) {
    const Saturation& saturation = *material_of(i).saturation;
    const geometry::MeshElement& element = mesh_->elements[at(element_[i])];
    if (!(saturation.flow->mobility > 0)) continue;
    for (const Index node : element.node_list()) {
      flows[at(node)] = 1;
      if (is_at_table(*mesh_, element, node, saturation.pore_water)) drains[at(node)] = 1;
    }
  }
  for (std::size_t e = 0; e < mesh_->elements.size(); ++e) {
    const geometry::MeshElement& element = mesh_->elements[e];
    const auto& saturation = (*materials_)[at((*material_)[e])].saturation;
    if (!saturation || (saturation->flow && saturation->pore_water.depth(centre(*mesh_, element)) > 0)) continue;
    for (const Index node : element.node_list()) drains[at(node)] = 1;
  }
  for (const Index node : node_) drained_.push_back(flows[at(node)] && drains[at(node)]);
}

template <int D>
std::span<const Index> Pores<D>::pressures_of(std::size_t number) const {
  return groups_.nodes(number).subspan(mesh_->elements[at(element_[number])].node_list().size());
}

template <int D>
Eigen::MatrixXd Pores<D>::corner_values(ElementShape shape) {
  const auto nodes = geometry::reference_nodes(shape);
  Eigen::MatrixXd values(facts(shape).corners, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t node = 0; node < nodes.size(); ++node)
    values.col(static_cast<Eigen::Index>(node)) = shape_values(corner_shape(shape), nodes[node]);
  return values;
}

/// Calls visit(point, pressure shape functions there).
template <int D>
template <class Visit>
void Pores<D>::visit_points(std::size_t number, std::span<const QuadraturePoint> points, Visit visit) const {
  const geometry::MeshElement& element = mesh_->elements[at(element_[number])];
  for (const QuadraturePoint& place : points)
    visit(solid_point<D>(*mesh_, element, place), Eigen::VectorXd(shape_values(corner_shape(element.shape), place.place)));
}

/// Adds a matrix by the pressures of an element.
template <int D>
void Pores<D>::add(std::size_t number, const Eigen::MatrixXd& by_pressure, BlockMatrix<D>& matrix) const {
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(by_pressure.rows() * D, by_pressure.cols() * D);
  for (Eigen::Index a = 0; a < by_pressure.rows(); ++a)
    for (Eigen::Index b = 0; b < by_pressure.cols(); ++b) blocks(a * D, b * D) = by_pressure(a, b);
  matrix.add(pressures_of(number), blocks);
}

template <int D>
void Pores<D>::add_storage(BlockMatrix<D>& matrix) const {
  constexpr Real square = pore_impedance * pore_impedance;
  for (std::size_t i = 0; i < size(); ++i) {
    const ElementShape shape = mesh_->elements[at(element_[i])].shape;
    const auto corners = facts(shape).corners;
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(corners, corners);
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(corners);
    Real volume = 0;
    visit_points(i, mass_points(shape), [&](const SolidPoint<D>& point, const Eigen::VectorXd& values) {
      products += point.weight * values * values.transpose();
      sums += point.weight * values;
      volume += point.weight;
    });
    Eigen::MatrixXd storage = material_of(i).saturation->flow->compressibility * products;
    if (!facts(shape).quadratic)
      storage += (products - sums * sums.transpose() / volume) / (2 * material_of(i).elastic.shear_modulus);
    add(i, square * storage, matrix);
  }
}

template <int D>
void Pores<D>::add_seepage(BlockMatrix<D>& matrix) const {
  constexpr Real square = pore_impedance * pore_impedance;
  for (std::size_t i = 0; i < size(); ++i) {
    const ElementShape shape = mesh_->elements[at(element_[i])].shape;
    const Eigen::MatrixXd corner = corner_values(shape);
    Eigen::MatrixXd flow = Eigen::MatrixXd::Zero(corner.rows(), corner.rows());
    visit_points(i, stiffness_points(shape, Integration::full), [&](const SolidPoint<D>& point, const Eigen::VectorXd&) {
      const Eigen::MatrixXd gradients = corner * point.gradients;
      flow += point.weight * gradients * gradients.transpose();
    });
    add(i, square * material_of(i).saturation->flow->mobility * flow, matrix);
  }
}

template <int D>
void Pores<D>::add_coupling(BlockMatrix<D>& matrix) const {
  for (std::size_t i = 0; i < size(); ++i) {
    const geometry::MeshElement& element = mesh_->elements[at(element_[i])];
    const auto nodes = static_cast<Eigen::Index>(element.node_list().size());
    const Eigen::Index all = nodes + facts(element.shape).corners;
    Eigen::MatrixXd both = Eigen::MatrixXd::Zero(all * D, all * D);
    visit_points(i, stiffness_points(element.shape, Integration::full),
                 [&](const SolidPoint<D>& point, const Eigen::VectorXd& values) {
                   for (Eigen::Index node = 0; node < nodes; ++node)
                     for (Eigen::Index corner = 0; corner < values.size(); ++corner)
                       for (int axis = 0; axis < D; ++axis) {
                         const Real q = pore_impedance * point.weight * point.gradients(node, axis) * values[corner];
                         both(node * D + axis, (nodes + corner) * D) -= q;
                         both((nodes + corner) * D, node * D + axis) += q;
                       }
                 });
    matrix.add(groups_.nodes(i), both);
  }
}

template <int D>
Real Pores<D>::mean(std::size_t number, const NodalColumn& velocity) const {
  Real sum = 0;
  for (const Index node : pressures_of(number)) sum += pore_pressure<D>(node, velocity);
  return sum / static_cast<Real>(pressures_of(number).size());
}

template <int D>
std::vector<Real> Pores<D>::at_points(std::size_t number, std::span<const QuadraturePoint> points,
                                      const NodalColumn& velocity) const {
  std::vector<Real> pressures;
  for (const QuadraturePoint& point : points) {
    const NodeValues values = shape_values(corner_shape(mesh_->elements[at(element_[number])].shape), point.place);
    Real pressure = 0;
    for (std::size_t corner = 0; corner < pressures_of(number).size(); ++corner)
      pressure += values[static_cast<Eigen::Index>(corner)] * pore_pressure<D>(pressures_of(number)[corner], velocity);
    pressures.push_back(pressure);
  }
  return pressures;
}

template <int D>
std::vector<std::pair<Index, Real>> Pores<D>::shares_at(Index node) const {
  std::vector<std::pair<Index, Real>> shares;
  for (std::size_t i = 0; i < size(); ++i) {
    const geometry::MeshElement& element = mesh_->elements[at(element_[i])];
    const auto nodes = element.node_list();
    const auto place = std::ranges::find(nodes, node);
    if (place == nodes.end()) continue;
    const Eigen::VectorXd values = corner_values(element.shape).col(place - nodes.begin());
    for (Eigen::Index corner = 0; corner < values.size(); ++corner)
      if (values[corner] != 0) shares.emplace_back(pressures_of(i)[static_cast<std::size_t>(corner)], values[corner]);
    break;
  }
  return shares;
}

template class Pores<2>;
template class Pores<3>;

}  // namespace sazare::methods::fem
