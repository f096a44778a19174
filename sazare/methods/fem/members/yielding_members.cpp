/// Members with limits of their force or moment.

#include <algorithm>
#include <map>

#include "sazare/methods/fem/members/members.hpp"
#include "sazare/methods/fem/nodal_algebra.hpp"

namespace sazare::methods::fem {
namespace {

constexpr Real no_limit = std::numeric_limits<Real>::infinity();

}  // namespace

Real MemberForces::force_ratio(const MemberSet& set) const {
  const Real in_compression = set.compression_force.value_or(set.yield_force);
  const Real pressed = in_compression > 0 ? -least_axial / in_compression : 0;
  return std::max({largest_axial / set.yield_force, pressed, Real{0}});
}

/// Hinges at both ends of every beam with a yield moment, but for one of two whose moments are the same.
template <int D>
void Members<D>::place_hinges() {
  struct End {
    std::size_t element = 0, end = 0;
  };
  std::map<Index, std::vector<End>> ends;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    Element& element = elements_[i];
    const MemberSet& set = sets_[element.set];
    if (set.kind != MemberKind::beam) continue;
    element.hinges = {set.youngs_modulus * set.second_moment / element.length, {set.yield_moment, set.yield_moment}};
    for (const std::size_t end : {0U, 1U}) ends[element.nodes[end]].push_back({i, end});
  }
  for (const auto& [node, meeting] : ends) {
    if (meeting.size() != 2) continue;
    const auto limit = [&](const End& one) -> Real& { return elements_[one.element].hinges.moment[one.end]; };
    const bool in_line = std::abs(elements_[meeting[0].element].along.dot(elements_[meeting[1].element].along)) > 1 - 1e-9;
    if (D == 2 || in_line) limit(limit(meeting[1]) < limit(meeting[0]) ? meeting[0] : meeting[1]) = no_limit;
  }
}

template <int D>
void Members<D>::find_yielding() {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    Element& element = elements_[i];
    const bool bends = std::ranges::any_of(element.hinges.moment, [](Real moment) { return moment > 0 && moment < no_limit; });
    const bool stretches = element.limits && (element.limits->yield < no_limit || element.limits->compression);
    element.yields = bends || stretches;
    if (!element.yields) continue;
    element.memory = memory_size_;
    memory_size_ += bends ? 2 * D : 1;
    yielding_.push_back(i);
  }
}

template <int D>
Eigen::VectorXd Members<D>::of_nodes(const Element& element, const NodalColumn& column) const {
  Eigen::VectorXd values(element.stiffness.cols());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = column[number<D>(element.nodes[static_cast<std::size_t>(i / D)], static_cast<int>(i % D))];
  return values;
}

template <int D>
typename Members<D>::Response Members<D>::respond(const Element& element, const Eigen::VectorXd& moved,
                                                  std::span<const Real> memory) const {
  return element.limits ? respond_bar(element, moved, memory) : respond_beam(element, moved, memory);
}

template <int D>
typename Members<D>::Response Members<D>::respond_bar(const Element& element, const Eigen::VectorXd& moved,
                                                      std::span<const Real> memory) const {
  Eigen::VectorXd stretch(2 * D);
  stretch << -element.along, element.along;
  const laws::AxialResponse found = laws::respond(*element.limits, stretch.dot(moved), memory[element.memory]);
  Response response;
  response.force = found.force * stretch;
  response.tangent = found.tangent * stretch * stretch.transpose();
  response.plastic = Eigen::VectorXd::Constant(1, found.plastic);
  response.conjugate = Eigen::VectorXd::Constant(1, found.force);
  response.energy = found.energy;
  return response;
}

/// Slopes of both ends against the chord, in vectors across the beam, by its freedoms.
template <int D>
Eigen::MatrixXd Members<D>::slopes(const Element& element) const {
  const Eigen::Matrix<Real, D, D> across = Eigen::Matrix<Real, D, D>::Identity() - element.along * element.along.transpose();
  const Eigen::Matrix<Real, D, D> slope = slope_of_rotation<D>(element.along);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(2 * D, 4 * D);
  for (const int end : {0, 1}) {
    all.template block<D, D>(end * D, 0) = across / element.length;
    all.template block<D, D>(end * D, D) = -across / element.length;
    all.template block<D, D>(end * D, (2 + end) * D) = slope;
  }
  return all;
}

/// The elastic beam, but for what hinges take from its bending.
template <int D>
typename Members<D>::Response Members<D>::respond_beam(const Element& element, const Eigen::VectorXd& moved,
                                                       std::span<const Real> memory) const {
  const Eigen::MatrixXd by_freedom = slopes(element);
  const Eigen::VectorXd slope = by_freedom * moved;
  const auto halves = [](const auto& both) { return std::array<Vector<D>, 2>{both.template head<D>(), both.template tail<D>()}; };
  const Eigen::Map<const Eigen::Matrix<Real, 2 * D, 1>> plastic(memory.data() + element.memory);
  const auto found = laws::respond<D>(element.hinges, halves(slope), halves(plastic));
  const laws::EndHinges elastic{element.hinges.stiffness, {no_limit, no_limit}};
  const auto whole = laws::respond<D>(elastic, halves(slope), {Vector<D>::Zero(), Vector<D>::Zero()});
  Response response;
  response.plastic = response.conjugate = Eigen::VectorXd(2 * D);
  response.plastic << found.plastic[0], found.plastic[1];
  response.conjugate << found.moment[0], found.moment[1];
  Eigen::VectorXd less(2 * D);
  less << found.moment[0] - whole.moment[0], found.moment[1] - whole.moment[1];
  const Eigen::VectorXd straight = element.stiffness * moved;
  response.force = straight + by_freedom.transpose() * less;
  response.tangent = element.stiffness;
  if (found.flows) response.tangent += by_freedom.transpose() * (found.tangent - whole.tangent) * by_freedom;
  response.energy = 0.5 * moved.dot(straight) - whole.energy + found.energy;
  return response;
}

template <int D>
void Members<D>::evaluate(std::size_t number, const NodalColumn& displacement, std::span<const Real> before,
                          std::span<Real> after, std::span<Real> force, std::span<Real> tangent) const {
  const Element& element = elements_[yielding_[number]];
  const Response found = respond(element, of_nodes(element, displacement), before);
  std::ranges::copy(found.plastic, after.begin() + static_cast<std::ptrdiff_t>(element.memory));
  std::ranges::copy(found.force, force.begin());
  if (tangent.empty()) return;
  using RowMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMatrix>(tangent.data(), found.force.size(), found.force.size()) = found.tangent;
}

template <int D>
typename Members<D>::Energies Members<D>::energies(std::size_t number, const NodalColumn& displacement_before,
                                                   const NodalColumn& displacement, std::span<const Real> before,
                                                   std::span<const Real> after) const {
  const Element& element = elements_[yielding_[number]];
  const Response old = respond(element, of_nodes(element, displacement_before), before);
  const Response now = respond(element, of_nodes(element, displacement), after);
  Energies result;
  result.elastic = now.energy;
  for (Eigen::Index i = 0; i < now.plastic.size(); ++i) {
    const std::size_t place = element.memory + static_cast<std::size_t>(i);
    result.plastic += 0.5 * (old.conjugate[i] + now.conjugate[i]) * (after[place] - before[place]);
  }
  return result;
}

template <int D>
void Members<D>::tell_plastic(const Element& element, const Response& response, MemberForces& found) const {
  if (element.limits) {
    const Real plastic = response.plastic[0];
    if (std::abs(plastic) > std::abs(found.plastic_elongation)) found.plastic_elongation = plastic;
    return;
  }
  for (const int end : {0, 1})
    found.plastic_rotation = std::max(found.plastic_rotation, response.plastic.template segment<D>(end * D).norm());
}

template <int D>
std::array<std::pair<Index, Real>, 2> Members<D>::plastic_by_node(std::size_t number, std::span<const Real> memory) const {
  const Element& element = elements_[yielding_[number]];
  std::array<std::pair<Index, Real>, 2> ends;
  for (const std::size_t end : {0U, 1U}) {
    const std::span<const Real> plastic =
        element.limits ? memory.subspan(element.memory, 1) : memory.subspan(element.memory + end * D, D);
    ends[end] = {element.nodes[end], Eigen::Map<const Eigen::VectorXd>(plastic.data(), std::ssize(plastic)).norm()};
  }
  return ends;
}

template <int D>
bool Members<D>::has_yielded(std::size_t number, std::span<const Real> memory) const {
  return std::ranges::any_of(plastic_by_node(number, memory), [](const auto& end) { return end.second > 0; });
}

// The class is instantiated in members.cpp, without these.
#define SAZARE_INSTANTIATE(D)                                                                                                    \
  template void Members<D>::place_hinges();                                                                                      \
  template void Members<D>::find_yielding();                                                                                     \
  template Eigen::VectorXd Members<D>::of_nodes(const Element&, const NodalColumn&) const;                                       \
  template typename Members<D>::Response Members<D>::respond(const Element&, const Eigen::VectorXd&, std::span<const Real>)      \
      const;                                                                                                                     \
  template Eigen::MatrixXd Members<D>::slopes(const Element&) const;                                                             \
  template typename Members<D>::Response Members<D>::respond_bar(const Element&, const Eigen::VectorXd&, std::span<const Real>)  \
      const;                                                                                                                     \
  template typename Members<D>::Response Members<D>::respond_beam(const Element&, const Eigen::VectorXd&, std::span<const Real>) \
      const;                                                                                                                     \
  template void Members<D>::evaluate(std::size_t, const NodalColumn&, std::span<const Real>, std::span<Real>, std::span<Real>,   \
                                     std::span<Real>) const;                                                                     \
  template typename Members<D>::Energies Members<D>::energies(std::size_t, const NodalColumn&, const NodalColumn&,               \
                                                              std::span<const Real>, std::span<const Real>) const;               \
  template void Members<D>::tell_plastic(const Element&, const Response&, MemberForces&) const;                                  \
  template std::array<std::pair<Index, Real>, 2> Members<D>::plastic_by_node(std::size_t, std::span<const Real>) const;          \
  template bool Members<D>::has_yielded(std::size_t, std::span<const Real>) const;

SAZARE_INSTANTIATE(2)
SAZARE_INSTANTIATE(3)
#undef SAZARE_INSTANTIATE

}  // namespace sazare::methods::fem
