#include "sazare/methods/fem/body.hpp"

#include <algorithm>
#include <atomic>

#include "sazare/parallel/threads.hpp"

namespace sazare::methods::fem {
namespace {

constexpr std::size_t serial_below = 64;  // yielding elements

}  // namespace

template <int D>
Body<D>::Body(BodyDescription description)
    : description_(std::move(description)),
      yielding_(description_.mesh, description_.materials, description_.material, description_.integration),
      joints_(description_.mesh, description_.joints),
      pores_(description_.mesh, description_.materials, description_.material),
      joint_pores_(description_.mesh, joints_, pores_),
      members_(description_.mesh, description_.members, description_.mass,
               static_cast<Index>(description_.mesh.nodes.size() + pores_.pressure_nodes())),
      pattern_(description_.mesh.nodes.size() + pores_.pressure_nodes() + members_.rotation_nodes(), all_groups()),
      mass_(pattern_),
      linear_(pattern_),
      buffer_(pattern_, changing_groups()) {
  prestress_.assign(freedoms(), 0);
  members_.add_prestress(prestress_);
  members_.add_stiffness(linear_, false);
  members_.add_mass(mass_);
  const geometry::ElementMesh& mesh = description_.mesh;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const SolidMaterial& material = description_.materials[at(description_.material[e])];
    const auto nodes = mesh.elements[e].node_list();
    mass_.add(nodes, element_mass<D>(mesh, mesh.elements[e], material, description_.mass));
    if (material.is_elastic())
      linear_.add(nodes, element_stiffness<D>(mesh, mesh.elements[e], material, description_.integration));
  }
}

template <int D>
NodeGroups Body<D>::all_groups() const {
  NodeGroups groups;
  for (const geometry::MeshElement& element : description_.mesh.elements) groups.add(element.node_list());
  for (std::size_t j = 0; j < joints_.size(); ++j) groups.add(joints_.nodes(j));
  for (std::size_t i = 0; i < pores_.size(); ++i) groups.add(pores_.nodes(i));
  for (std::size_t i = 0; i < joint_pores_.size(); ++i) groups.add(joint_pores_.nodes(i));
  for (std::size_t i = 0; i < members_.size(); ++i) groups.add(members_.nodes(i));
  return groups;
}

template <int D>
NodeGroups Body<D>::changing_groups() const {
  NodeGroups groups;
  for (std::size_t i = 0; i < yielding_.size(); ++i) groups.add(description_.mesh.elements[at(yielding_.element(i))].node_list());
  for (std::size_t j = 0; j < joints_.size(); ++j) groups.add(joints_.nodes(j));
  for (std::size_t i = 0; i < members_.yielding(); ++i) groups.add(members_.yielding_nodes(i));
  return groups;
}

template <int D>
NodalColumn Body<D>::at_all_nodes(const Vector<D>& value) const {
  NodalColumn all(freedoms(), 0);
  for (std::size_t i = 0; i < description_.mesh.nodes.size() * D; ++i) all[i] = value[static_cast<int>(i % D)];
  return all;
}

template <int D>
Real Body<D>::total_mass() const {
  NodalColumn sums(freedoms(), 0);
  mass_.multiply(at_all_nodes(Vector<D>::Unit(0)), 1, sums);
  Real total = 0;
  for (std::size_t i = 0; i < description_.mesh.nodes.size() * D; i += D) total += sums[i];
  return total;
}

template <int D>
bool Body<D>::is_symmetric() const {
  const auto associated = [](const SolidMaterial& material) { return material.is_associated(); };
  const auto frictionless = [](const JointSet& set) { return set.law.friction_coefficient == 0; };
  return std::ranges::all_of(description_.materials, associated) && std::ranges::all_of(description_.joints, frictionless);
}

template <int D>
BlockMatrix<D> Body<D>::elastic_stiffness() const {
  BlockMatrix<D> result = linear_;
  members_.add_stiffness(result, true);
  const geometry::ElementMesh& mesh = description_.mesh;
  for (std::size_t i = 0; i < yielding_.size(); ++i) {
    const std::size_t e = at(yielding_.element(i));
    const SolidMaterial& material = description_.materials[at(description_.material[e])];
    result.add(mesh.elements[e].node_list(), element_stiffness<D>(mesh, mesh.elements[e], material, description_.integration));
  }
  return result;
}

template <int D>
BlockMatrix<D> Body<D>::damping_matrix(const laws::RayleighDamping& damping) const {
  BlockMatrix<D> result(pattern_);
  members_.add_damping(damping.mass_rate, damping.stiffness_time, result);
  const geometry::ElementMesh& mesh = description_.mesh;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const SolidMaterial& material = description_.materials[at(description_.material[e])];
    if (!(material.damping_ratio > 0)) continue;
    const auto nodes = mesh.elements[e].node_list();
    result.add(nodes, element_mass<D>(mesh, mesh.elements[e], material, description_.mass),
               damping.mass_rate * material.damping_ratio);
    result.add(nodes, element_stiffness<D>(mesh, mesh.elements[e], material, description_.integration),
               damping.stiffness_time * material.damping_ratio);
  }
  return result;
}

template <int D>
template <class Visit>
void Body<D>::visit_pores(Visit visit) const {
  const geometry::ElementMesh& mesh = description_.mesh;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const geometry::MeshElement& element = mesh.elements[e];
    const auto& saturation = description_.materials[at(description_.material[e])].saturation;
    if (!saturation) continue;
    for (const QuadraturePoint& place : stiffness_points(element.shape, description_.integration)) {
      const NodeValues values = shape_values(element.shape, place.place);
      Vector3 position = Vector3::Zero();
      for (std::size_t i = 0; i < element.node_list().size(); ++i)
        position += values[static_cast<Eigen::Index>(i)] * mesh.nodes[at(element.nodes[i])];
      visit(e, solid_point<D>(mesh, element, place), saturation->pore_water.pressure(position));
    }
  }
}

template <int D>
NodalColumn Body<D>::pore_force() const {
  NodalColumn force(freedoms(), 0);
  visit_pores([&](std::size_t e, const SolidPoint<D>& point, Real pressure) {
    const auto nodes = description_.mesh.elements[e].node_list();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int axis = 0; axis < D; ++axis)
        force[at(nodes[i]) * D + static_cast<std::size_t>(axis)] +=
            point.weight * pressure * point.gradients(static_cast<Eigen::Index>(i), axis);
  });
  return force;
}

template <int D>
std::vector<Real> Body<D>::pore_pressures() const {
  std::vector<Real> pressure(description_.mesh.elements.size(), 0), volume(pressure.size(), 0);
  visit_pores([&](std::size_t e, const SolidPoint<D>& point, Real there) {
    pressure[e] += point.weight * there;
    volume[e] += point.weight;
  });
  for (std::size_t e = 0; e < pressure.size(); ++e)
    if (volume[e] > 0) pressure[e] /= volume[e];
  return pressure;
}

template <int D>
Memory Body<D>::memory_at_rest() const {
  return {std::vector<Real>(yielding_.memory_size(), 0), std::vector<Real>(joints_.memory_size(), 0),
          std::vector<Real>(members_.memory_size(), 0)};
}

template <int D>
void Body<D>::begin_cycles(const NodalColumn& displacement, Memory& memory) const {
  for (std::size_t i = 0; i < yielding_.size(); ++i) yielding_.begin_cycles(i, displacement, memory.solids);
}

template <int D>
bool Body<D>::evaluate(const NodalColumn& displacement, const Memory& before, Memory& after, NodalColumn& force,
                       BlockMatrix<D>* tangent) {
  force = prestress_;
  linear_.multiply(displacement, 1, force);
  std::atomic<bool> changed = !has_tangent_;
  parallel::parallel_for(buffer_.groups(), serial_below, [&](std::size_t begin, std::size_t end) {
    std::vector<Real> old;
    for (std::size_t group = begin; group < end; ++group) {
      const auto matrix = tangent == nullptr ? std::span<Real>{} : buffer_.matrix(group);
      old.assign(matrix.begin(), matrix.end());
      const std::size_t solids = yielding_.size(), joints = solids + joints_.size();
      if (group < solids)
        yielding_.evaluate(group, displacement, before.solids, after.solids, buffer_.force(group), matrix);
      else if (group < joints)
        joints_.evaluate(group - solids, displacement, before.joints, after.joints, buffer_.force(group), matrix);
      else
        members_.evaluate(group - joints, displacement, before.members, after.members, buffer_.force(group), matrix);
      if (!std::ranges::equal(old, matrix)) changed = true;
    }
  });
  buffer_.gather_forces(force);
  if (tangent == nullptr || !changed) return false;
  tangent->values() = linear_.values();
  buffer_.gather_matrices(*tangent);
  has_tangent_ = true;
  return true;
}

template <int D>
typename Body<D>::Energies Body<D>::energies(const NodalColumn& displacement_before, const NodalColumn& displacement,
                                             const Memory& before, const Memory& after) const {
  NodalColumn force(freedoms(), 0);
  linear_.multiply(displacement, 1, force);
  Energies result;
  for (std::size_t i = 0; i < force.size(); ++i) result.elastic += (0.5 * force[i] + prestress_[i]) * displacement[i];
  for (std::size_t i = 0; i < yielding_.size(); ++i) {
    const auto part = yielding_.energies(i, displacement_before, displacement, before.solids, after.solids);
    result.elastic += part.elastic;
    result.plastic += part.plastic;
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto part = joints_.energies(j, displacement_before, displacement, before.joints, after.joints);
    result.elastic += part.elastic;
    result.friction += part.friction;
  }
  for (std::size_t i = 0; i < members_.yielding(); ++i) {
    const auto part = members_.energies(i, displacement_before, displacement, before.members, after.members);
    result.elastic += part.elastic;
    result.members += part.plastic;
  }
  return result;
}

template <int D>
std::vector<SolidMean<D>> Body<D>::means(const NodalColumn& displacement, const Memory& memory) const {
  const geometry::ElementMesh& mesh = description_.mesh;
  std::vector<SolidMean<D>> means(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const SolidMaterial& material = description_.materials[at(description_.material[e])];
    if (!material.is_elastic()) continue;
    const ElementColumn<D> moved = displacements_of<D>(mesh.elements[e], displacement);
    Voigt<D> strain = Voigt<D>::Zero();
    Real volume = 0;
    for (const QuadraturePoint& place : stiffness_points(mesh.elements[e].shape, description_.integration)) {
      const SolidPoint<D> point = solid_point<D>(mesh, mesh.elements[e], place);
      strain += point.weight * (strain_matrix<D>(point.gradients) * moved);
      volume += point.weight;
    }
    means[e].stress = fem::elastic_stiffness<D>(material.elastic) * (strain / volume);
  }
  for (std::size_t i = 0; i < yielding_.size(); ++i)
    means[at(yielding_.element(i))] = yielding_.mean(i, displacement, memory.solids);
  return means;
}

template <int D>
std::vector<std::vector<Voigt<D>>> Body<D>::point_stresses(const NodalColumn& displacement, const Memory& memory) const {
  const geometry::ElementMesh& mesh = description_.mesh;
  std::vector<std::vector<Voigt<D>>> stresses(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const SolidMaterial& material = description_.materials[at(description_.material[e])];
    if (!material.is_elastic()) continue;
    const ElementColumn<D> moved = displacements_of<D>(mesh.elements[e], displacement);
    for (const QuadraturePoint& place : stiffness_points(mesh.elements[e].shape, description_.integration)) {
      const Voigt<D> strain = strain_matrix<D>(solid_point<D>(mesh, mesh.elements[e], place).gradients) * moved;
      stresses[e].push_back(fem::elastic_stiffness<D>(material.elastic) * strain);
    }
  }
  for (std::size_t i = 0; i < yielding_.size(); ++i)
    stresses[at(yielding_.element(i))] = yielding_.stresses(i, displacement, memory.solids);
  return stresses;
}

template class Body<2>;
template class Body<3>;

}  // namespace sazare::methods::fem
