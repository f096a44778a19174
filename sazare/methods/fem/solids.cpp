#include "sazare/methods/fem/solids.hpp"

#include <fmt/format.h>

#include "sazare/core/error.hpp"

namespace sazare::methods::fem {

namespace {

/// A line stands for layers without end: nothing changes along them, so that all gradients are vertical.
template <int D>
SolidPoint<D> layer_point(const geometry::ElementMesh& mesh, const geometry::MeshElement& element, const QuadraturePoint& point) {
  const NodeGradients by_reference = shape_gradients(element.shape, point.place);
  Real stretch = 0;
  for (Eigen::Index i = 0; i < by_reference.rows(); ++i)
    stretch += by_reference(i, 0) * mesh.nodes[at(element.nodes[at(i)])][D - 1];
  Gradients<D> gradients = Gradients<D>::Zero(by_reference.rows(), D);
  gradients.col(D - 1) = by_reference.col(0) / stretch;
  return {stretch * point.weight, gradients};
}

}  // namespace

template <int D>
SolidPoint<D> solid_point(const geometry::ElementMesh& mesh, const geometry::MeshElement& element, const QuadraturePoint& point) {
  if (facts(element.shape).dimension == 1) return layer_point<D>(mesh, element, point);
  const NodeGradients by_reference = shape_gradients(element.shape, point.place);
  Eigen::Matrix<Real, D, D> jacobian = Eigen::Matrix<Real, D, D>::Zero();
  for (Eigen::Index i = 0; i < by_reference.rows(); ++i)
    jacobian += mesh.nodes[at(element.nodes[at(i)])].template head<D>() * by_reference.row(i).template head<D>();
  const Real volume = jacobian.determinant();
  if (!(volume > 0)) {
    const Vector3& place = mesh.nodes[at(element.nodes[0])];
    throw UserError(
        fmt::format("element {} ({}) at ({:.6g}, {:.6g}, {:.6g}) m has no volume, or is inverted. Check the mesh there; curved "
                    "sides may need smaller elements",
                    element.tag, facts(element.shape).name, place.x(), place.y(), place.z()));
  }
  // Node by node, because Eigen rounds a product of whole tables differently depending on where in memory the result stands.
  const Eigen::Matrix<Real, D, D> inverse = jacobian.inverse();
  Gradients<D> gradients(by_reference.rows(), D);
  for (Eigen::Index i = 0; i < by_reference.rows(); ++i) gradients.row(i) = by_reference.row(i).template head<D>() * inverse;
  return {volume * point.weight, gradients};
}

Vector3 centre(const geometry::ElementMesh& mesh, const geometry::MeshElement& element) {
  Vector3 sum = Vector3::Zero();
  for (const Index node : element.node_list()) sum += mesh.nodes[at(node)];
  return sum / static_cast<Real>(element.node_list().size());
}

template <int D>
StrainMatrix<D> strain_matrix(const Gradients<D>& gradients) {
  StrainMatrix<D> b(stress_size<D>, gradients.rows() * D);
  for (Eigen::Index node = 0; node < gradients.rows(); ++node)
    b.template middleCols<D>(node * D) = strain_operator<D>(gradients.row(node).transpose());
  return b;
}

template <int D>
ElementColumn<D> displacements_of(const geometry::MeshElement& element, const NodalColumn& displacement) {
  const auto nodes = element.node_list();
  ElementColumn<D> moved(nodes.size() * D);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t axis = 0; axis < D; ++axis)
      moved[static_cast<Eigen::Index>(i * D + axis)] = displacement[at(nodes[i]) * D + axis];
  return moved;
}

template <int D>
Eigen::MatrixXd element_stiffness(const geometry::ElementMesh& mesh, const geometry::MeshElement& element,
                                  const SolidMaterial& material, Integration integration) {
  const auto size = static_cast<Eigen::Index>(element.node_list().size()) * D;
  const VoigtMatrix<D> c = elastic_stiffness<D>(material.elastic);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
  for (const QuadraturePoint& place : stiffness_points(element.shape, integration)) {
    const SolidPoint<D> point = solid_point<D>(mesh, element, place);
    const StrainMatrix<D> b = strain_matrix<D>(point.gradients);
    k += point.weight * (b.transpose() * (c * b));
  }
  return 0.5 * (k + k.transpose());
}

template <int D>
Eigen::MatrixXd element_mass(const geometry::ElementMesh& mesh, const geometry::MeshElement& element,
                             const SolidMaterial& material, MassMatrix kind) {
  const auto nodes = static_cast<Eigen::Index>(element.node_list().size());
  Eigen::MatrixXd by_node = Eigen::MatrixXd::Zero(nodes, nodes);
  Real whole = 0;
  for (const QuadraturePoint& place : mass_points(element.shape)) {
    const NodeValues n = shape_values(element.shape, place.place);
    Vector3 at_point = Vector3::Zero();
    for (Eigen::Index a = 0; a < nodes; ++a) at_point += n[a] * mesh.nodes[at(element.nodes[static_cast<std::size_t>(a)])];
    const Real mass = material.density_at(at_point) * solid_point<D>(mesh, element, place).weight;
    by_node += mass * n * n.transpose();
    whole += mass;
  }
  if (kind == MassMatrix::lumped) {
    const Eigen::VectorXd diagonal = by_node.diagonal() * (whole / by_node.diagonal().sum());
    by_node = diagonal.asDiagonal();
  }
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(nodes * D, nodes * D);
  for (Eigen::Index a = 0; a < nodes; ++a)
    for (Eigen::Index b = 0; b < nodes; ++b)
      for (int axis = 0; axis < D; ++axis) m(a * D + axis, b * D + axis) = by_node(a, b);
  return m;
}

template <int D>
YieldingSolids<D>::YieldingSolids(const geometry::ElementMesh& mesh, const std::vector<SolidMaterial>& materials,
                                  const std::vector<Index>& material, Integration integration)
    : mesh_(&mesh), first_point_{0} {
  for (const SolidMaterial& one : materials) law_.push_back(point_law<D>(one));
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (materials[at(material[e])].is_elastic()) continue;
    element_.push_back(static_cast<Index>(e));
    material_.push_back(material[e]);
    const std::size_t by_point = std::visit([](const auto& one) { return one.memory_size(); }, law_[at(material[e])]);
    for (const QuadraturePoint& place : stiffness_points(mesh.elements[e].shape, integration)) {
      point_.push_back({solid_point<D>(mesh, mesh.elements[e], place), memory_size_});
      memory_size_ += by_point;
    }
    first_point_.push_back(point_.size());
  }
}

template <int D>
void YieldingSolids<D>::evaluate(std::size_t number, const NodalColumn& displacement, std::span<const Real> before,
                                 std::span<Real> after, std::span<Real> force, std::span<Real> tangent) const {
  const geometry::MeshElement& element = mesh_->elements[at(element_[number])];
  const ElementColumn<D> moved = displacements_of<D>(element, displacement);
  Eigen::Map<Eigen::VectorXd> f(force.data(), moved.size());
  using RowMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMatrix> k(tangent.data(), tangent.empty() ? 0 : moved.size(), tangent.empty() ? 0 : moved.size());
  f.setZero();
  k.setZero();
  std::visit(
      [&](const auto& law) {
        for (const Point& point : points(number)) {
          const StrainMatrix<D> b = strain_matrix<D>(point.gradients);
          VoigtMatrix<D> c;
          const Voigt<D> stress =
              law.respond(b * moved, before.subspan(point.memory), after.subspan(point.memory), tangent.empty() ? nullptr : &c);
          f.noalias() += point.weight * (b.transpose() * stress);
          if (!tangent.empty()) k.noalias() += point.weight * (b.transpose() * (c * b));
        }
      },
      law(number));
}

template <int D>
typename YieldingSolids<D>::Energies YieldingSolids<D>::energies(std::size_t number, const NodalColumn& displacement_before,
                                                                 const NodalColumn& displacement, std::span<const Real> before,
                                                                 std::span<const Real> after) const {
  const geometry::MeshElement& element = mesh_->elements[at(element_[number])];
  const ElementColumn<D> old = displacements_of<D>(element, displacement_before),
                         now = displacements_of<D>(element, displacement);
  Energies result;
  std::visit(
      [&](const auto& law) {
        for (const Point& point : points(number)) {
          const StrainMatrix<D> b = strain_matrix<D>(point.gradients);
          const PointEnergies part = law.energies(b * old, b * now, before.subspan(point.memory), after.subspan(point.memory));
          result.elastic += point.weight * part.elastic;
          result.plastic += point.weight * part.plastic;
        }
      },
      law(number));
  return result;
}

template <int D>
void YieldingSolids<D>::begin_cycles(std::size_t number, const NodalColumn& displacement, std::span<Real> memory) const {
  const auto* const strength = std::get_if<StrengthAtPoint<D>>(&law(number));
  if (strength == nullptr) return;
  const ElementColumn<D> moved = displacements_of<D>(mesh_->elements[at(element_[number])], displacement);
  for (const Point& point : points(number))
    strength->begin_cycles(strain_matrix<D>(point.gradients) * moved, memory.subspan(point.memory));
}

template <int D>
SolidMean<D> YieldingSolids<D>::mean(std::size_t number, const NodalColumn& displacement, std::span<const Real> memory) const {
  const ElementColumn<D> moved = displacements_of<D>(mesh_->elements[at(element_[number])], displacement);
  SolidMean<D> mean;
  Real volume = 0;
  std::visit(
      [&](const auto& law) {
        for (const Point& point : points(number)) {
          const auto own = memory.subspan(point.memory);
          mean.stress += point.weight * law.stress(strain_matrix<D>(point.gradients) * moved, own);
          mean.slip += point.weight * law.slip(own);
          mean.peak += point.weight * law.peak(own);
          volume += point.weight;
        }
      },
      law(number));
  return {mean.stress / volume, mean.slip / volume, mean.peak / volume};
}

template <int D>
std::vector<Voigt<D>> YieldingSolids<D>::stresses(std::size_t number, const NodalColumn& displacement,
                                                  std::span<const Real> memory) const {
  const ElementColumn<D> moved = displacements_of<D>(mesh_->elements[at(element_[number])], displacement);
  std::vector<Voigt<D>> found;
  std::visit(
      [&](const auto& law) {
        for (const Point& point : points(number))
          found.push_back(law.stress(strain_matrix<D>(point.gradients) * moved, memory.subspan(point.memory)));
      },
      law(number));
  return found;
}

template SolidPoint<2> solid_point<2>(const geometry::ElementMesh&, const geometry::MeshElement&, const QuadraturePoint&);
template SolidPoint<3> solid_point<3>(const geometry::ElementMesh&, const geometry::MeshElement&, const QuadraturePoint&);
template StrainMatrix<2> strain_matrix<2>(const Gradients<2>&);
template StrainMatrix<3> strain_matrix<3>(const Gradients<3>&);
template ElementColumn<2> displacements_of<2>(const geometry::MeshElement&, const NodalColumn&);
template ElementColumn<3> displacements_of<3>(const geometry::MeshElement&, const NodalColumn&);
template Eigen::MatrixXd element_stiffness<2>(const geometry::ElementMesh&, const geometry::MeshElement&, const SolidMaterial&,
                                              Integration);
template Eigen::MatrixXd element_stiffness<3>(const geometry::ElementMesh&, const geometry::MeshElement&, const SolidMaterial&,
                                              Integration);
template Eigen::MatrixXd element_mass<2>(const geometry::ElementMesh&, const geometry::MeshElement&, const SolidMaterial&,
                                         MassMatrix);
template Eigen::MatrixXd element_mass<3>(const geometry::ElementMesh&, const geometry::MeshElement&, const SolidMaterial&,
                                         MassMatrix);
template class YieldingSolids<2>;
template class YieldingSolids<3>;

}  // namespace sazare::methods::fem
