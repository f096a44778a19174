#include "sazare/methods/fem/members/members.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sazare/core/error.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"

namespace sazare::methods::fem {
namespace {

constexpr Real poisson_ratio = 0.3;  // of the twist of beams

/// Deflection and slope at either end, of the cubic of a beam with EI = 1.
Eigen::Matrix4d bending_stiffness(Real length) {
  const Real l = length;
  Eigen::Matrix4d k;
  k << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l, -6 * l, 4 * l * l;
  return k / (l * l * l);
}

/// The same, of a beam whose mass is 1.
Eigen::Matrix4d bending_mass(Real length, MassMatrix kind) {
  const Real l = length;
  if (kind == MassMatrix::lumped) return Eigen::Vector4d(0.5, l * l / 78, 0.5, l * l / 78).asDiagonal();
  Eigen::Matrix4d m;
  m << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l, -3 * l * l, -22 * l,
      4 * l * l;
  return m / 420;
}

Eigen::Matrix2d line_mass(MassMatrix kind) {
  if (kind == MassMatrix::lumped) return Eigen::Vector2d(0.5, 0.5).asDiagonal();
  return (Eigen::Matrix2d() << 1.0 / 3, 1.0 / 6, 1.0 / 6, 1.0 / 3).finished();
}

const Eigen::Matrix2d line_stiffness = (Eigen::Matrix2d() << 1, -1, -1, 1).finished();

/// Adds scalars of two ends times a matrix of components, from a row and column of blocks on.
template <int D>
void add_ends(Eigen::MatrixXd& to, int first, const Eigen::Matrix2d& by_end, const Eigen::Matrix<Real, D, D>& components) {
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) to.block<D, D>((first + a) * D, (first + b) * D) += by_end(a, b) * components;
}

}  // namespace

template <int D>
Members<D>::Members(const geometry::ElementMesh& mesh, std::vector<MemberSet> sets, MassMatrix mass, Index first_rotation)
    : sets_(std::move(sets)), first_rotation_(first_rotation) {
  std::set<Index> turning;
  for (const MemberSet& set : sets_)
    if (set.kind == MemberKind::beam)
      for (const auto& line : set.lines) turning.insert(line.begin(), line.end());
  node_.assign(turning.begin(), turning.end());
  for (std::size_t set = 0; set < sets_.size(); ++set)
    for (const auto& line : sets_[set].lines) elements_.push_back(make(set, line, mesh, mass));
  if constexpr (D == 3) steady_spins();
  place_hinges();
  find_yielding();
}

template <int D>
Index Members<D>::rotation_of(Index node) const {
  return first_rotation_ + static_cast<Index>(std::ranges::lower_bound(node_, node) - node_.begin());
}

template <int D>
typename Members<D>::Element Members<D>::make(std::size_t set, const std::array<Index, 2>& ends,
                                              const geometry::ElementMesh& mesh, MassMatrix mass) const {
  const MemberSet& of = sets_[set];
  const Vector<D> way = (mesh.nodes[at(ends[1])] - mesh.nodes[at(ends[0])]).template head<D>();
  const Real length = way.norm();
  if (!(length > 0)) throw UserError(fmt::format("a line of the member \"{}\" has no length: its ends are one place", of.name));
  Element element;
  element.set = set;
  element.nodes = {ends[0], ends[1]};
  element.length = length;
  element.along = way / length;
  const Eigen::Matrix<Real, D, D> along = element.along * element.along.transpose();
  const int size = of.kind == MemberKind::beam ? 4 * D : 2 * D;
  element.stiffness = element.mass = element.damping = Eigen::MatrixXd::Zero(size, size);
  const Real stretch = of.kind == MemberKind::spring ? of.stiffness : of.youngs_modulus * of.area / length;
  if (of.kind != MemberKind::dashpot) add_ends<D>(element.stiffness, 0, stretch * line_stiffness, along);
  if (of.kind == MemberKind::bar || of.kind == MemberKind::spring)
    element.limits = laws::AxialLimits{stretch, of.prestress, of.yield_force, of.compression_force};
  if (of.kind == MemberKind::dashpot) add_ends<D>(element.damping, 0, of.damping * line_stiffness, along);
  const Real whole = of.density * of.area * length;
  const Eigen::Matrix<Real, D, D> all = Eigen::Matrix<Real, D, D>::Identity();
  if (of.kind == MemberKind::bar) add_ends<D>(element.mass, 0, whole * line_mass(mass), all);
  if (of.kind == MemberKind::beam) make_beam(of, length, mass, element);
  return element;
}

/// Blocks: ends, then rotations.
template <int D>
void Members<D>::make_beam(const MemberSet& of, Real length, MassMatrix mass, Element& element) const {
  for (const Index end : {0, 1}) element.nodes.push_back(rotation_of(element.nodes[static_cast<std::size_t>(end)]));
  const Eigen::Matrix<Real, D, D> along = element.along * element.along.transpose();
  const Eigen::Matrix<Real, D, D> across = Eigen::Matrix<Real, D, D>::Identity() - along;
  const Eigen::Matrix<Real, D, D> slope = slope_of_rotation<D>(element.along);
  const Eigen::Matrix4d k = of.youngs_modulus * of.second_moment * bending_stiffness(length);
  const Real whole = of.density * of.area * length;
  const Eigen::Matrix4d m = whole * bending_mass(length, mass);
  constexpr std::array<int, 4> block = {0, 2, 1, 3};  // of deflection and slope at either end
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const Eigen::Matrix<Real, D, D> left = a % 2 == 0 ? across : slope, right = b % 2 == 0 ? across : slope;
      const Eigen::Matrix<Real, D, D> components = left.transpose() * right;
      element.stiffness.template block<D, D>(block[at(a)] * D, block[at(b)] * D) += k(a, b) * components;
      element.mass.template block<D, D>(block[at(a)] * D, block[at(b)] * D) += m(a, b) * components;
    }
  add_ends<D>(element.mass, 0, whole * line_mass(mass), along);
  if constexpr (D == 3) {
    const Real polar = 2 * of.second_moment;
    add_ends<3>(element.stiffness, 2, of.youngs_modulus / (2 * (1 + poisson_ratio)) * polar / length * line_stiffness, along);
    add_ends<3>(element.mass, 2, of.density * polar * length * line_mass(mass), along);
  }
}

/// Nothing turns a straight beam about its own axis, alone or with others in line: its first node is kept from it, by a spring
/// that bears nothing.
template <int D>
void Members<D>::steady_spins() {
  std::vector<std::size_t> chain(elements_.size());
  for (std::size_t i = 0; i < chain.size(); ++i) chain[i] = i;
  const auto shares = [&](std::size_t a, std::size_t b) {
    return std::ranges::any_of(elements_[a].nodes, [&](Index n) { return std::ranges::count(elements_[b].nodes, n) > 0; });
  };
  const auto is_beam = [&](std::size_t i) { return sets_[elements_[i].set].kind == MemberKind::beam; };
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t a = 0; a < chain.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (is_beam(a) && is_beam(b) && chain[a] != chain[b] && shares(a, b)) {
          chain[a] = chain[b] = std::min(chain[a], chain[b]);
          grows = true;
        }
  }
  for (std::size_t first = 0; first < chain.size(); ++first) {
    if (chain[first] != first || !is_beam(first)) continue;
    Element& element = elements_[first];
    bool straight = true;
    for (std::size_t i = first; i < chain.size(); ++i)
      if (chain[i] == first) straight = straight && std::abs(elements_[i].along.dot(element.along)) > 1 - 1e-9;
    if (!straight) continue;
    const Real twist = element.along.dot(element.stiffness.template block<D, D>(2 * D, 2 * D) * element.along);
    element.stiffness.template block<D, D>(2 * D, 2 * D) += twist * element.along * element.along.transpose();
  }
}

template <int D>
void Members<D>::add_stiffness(BlockMatrix<D>& matrix, bool of_yielding) const {
  for (const Element& element : elements_)
    if (element.yields == of_yielding) matrix.add(element.nodes, element.stiffness);
}

template <int D>
void Members<D>::add_mass(BlockMatrix<D>& matrix) const {
  for (const Element& element : elements_) matrix.add(element.nodes, element.mass);
}

template <int D>
void Members<D>::add_damping(Real mass_rate, Real stiffness_time, BlockMatrix<D>& matrix) const {
  for (const Element& element : elements_) {
    const Real ratio = sets_[element.set].damping_ratio;
    matrix.add(element.nodes, element.damping + ratio * (mass_rate * element.mass + stiffness_time * element.stiffness));
  }
}

template <int D>
void Members<D>::add_prestress(NodalColumn& force) const {
  for (const Element& element : elements_)
    for (int axis = 0; axis < D && !element.yields; ++axis) {
      const Real part = sets_[element.set].prestress * element.along[axis];
      force[number<D>(element.nodes[0], axis)] -= part;
      force[number<D>(element.nodes[1], axis)] += part;
    }
}

template <int D>
MemberForces Members<D>::forces(std::size_t set, const NodalColumn& displacement, const NodalColumn& velocity,
                                std::span<const Real> memory) const {
  MemberForces found;
  bool is_first = true;
  for (const Element& element : elements_) {
    if (element.set != set) continue;
    const Eigen::VectorXd moved = of_nodes(element, displacement), speed = of_nodes(element, velocity);
    Eigen::VectorXd force = element.stiffness * moved + element.damping * speed;
    Real prestress = sets_[set].prestress;
    if (element.yields) {
      const Response response = respond(element, moved, memory);
      force = response.force + element.damping * speed;
      prestress = 0;  // is part of the response
      tell_plastic(element, response, found);
    }
    const Vector<D> end = force.template segment<D>(D);
    const Real axial = end.dot(element.along) + prestress;
    found.least_axial = is_first ? axial : std::min(found.least_axial, axial);
    found.largest_axial = is_first ? axial : std::max(found.largest_axial, axial);
    is_first = false;
    if (sets_[set].kind != MemberKind::beam) continue;
    found.shear = std::max(found.shear, (end - end.dot(element.along) * element.along).norm());
    for (const int block : {2, 3}) {
      Vector<D> moment = force.template segment<D>(block * D);
      if constexpr (D == 3) moment -= moment.dot(element.along) * element.along;
      found.moment = std::max(found.moment, moment.norm());
    }
  }
  return found;
}

template class Members<2>;
template class Members<3>;

}  // namespace sazare::methods::fem
