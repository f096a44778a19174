/// Which numbers of a step are unknown, and the solver for them.

#include <map>
#include <numeric>
#include <set>

#include "sazare/methods/fem/nodal_algebra.hpp"
#include "sazare/methods/fem/stepper.hpp"

namespace sazare::methods::fem {

/// A solver for the free degrees of freedom.
template <int D>
void FemStepper<D>::prepare_solver(bool at_rest) {
  find_unknowns(at_rest);
  solver_ = std::make_unique<methods::fem::LinearSolver<D>>(body_->pattern(), unknowns_, body_->is_symmetric());
  mass_solver_.reset();
  factorized_.reset();
}

/// What is free. While relaxing the water in the pores is at rest.
template <int D>
void FemStepper<D>::find_unknowns(bool at_rest) {
  unknowns_.is_free.assign(body_->freedoms(), 1);
  const std::set<Index> drained(supports_.drained.begin(), supports_.drained.end());
  const auto& pores = body_->pores();
  unknowns_.turned_from = body_->mesh().nodes.size();
  unknowns_.turned_to = unknowns_.turned_from + pores.pressure_nodes();
  for (std::size_t pressure = 0; pressure < pores.pressure_nodes(); ++pressure)
    for (int axis = 0; axis < D; ++axis)
      unknowns_.is_free[number<D>(pores.pressure_node(pressure), axis)] =
          axis == 0 && !at_rest && !pores.is_drained(pressure) && !drained.contains(pores.node_of(pressure));
  const auto& members = body_->members();
  for (std::size_t rotation = 0; rotation < members.rotation_nodes(); ++rotation)
    for (int axis = 0; axis < D; ++axis)
      unknowns_.is_free[number<D>(members.rotation_node(rotation), axis)] =
          (D == 3 || axis == 0) && std::ranges::count(supports_.clamped, members.node_of(rotation)) == 0;
  for (const Support& support : supports_.held) unknowns_.is_free[number<D>(support.node, support.axis)] = 0;
  if (at_rest) hold_sides();
  if (!supports_.tied.empty()) find_leaders();
}

/// Viscous boundaries and free-field sides hold the body while it relaxes.
template <int D>
void FemStepper<D>::hold_sides() {
  for (const auto& side : supports_.sides)
    for (const Index node : side.nodes) unknowns_.is_free[number<D>(node, side.across)] = 0;
  for (const auto& boundary : supports_.viscous)
    for (const auto& face : boundary.faces)
      for (const Index node : face.nodes)
        for (int axis = 0; axis < D; ++axis) unknowns_.is_free[number<D>(node, axis)] = 0;
}

/// Tied nodes have their displacement in common, and where both have them their pressure and their rotation.
template <int D>
void FemStepper<D>::find_leaders() {
  unknowns_.leader.resize(body_->freedoms());
  std::iota(unknowns_.leader.begin(), unknowns_.leader.end(), std::size_t{0});
  const auto tie = [&](Index node, Index leader) {
    for (int axis = 0; axis < D; ++axis) {
      const std::size_t follower = number<D>(node, axis), first = number<D>(leader, axis);
      unknowns_.leader[follower] = first;
      unknowns_.is_free[first] = unknowns_.is_free[first] && unknowns_.is_free[follower];
      unknowns_.is_free[follower] = 0;
    }
  };
  std::map<Index, Index> pressure_of;
  const auto& pores = body_->pores();
  for (std::size_t pressure = 0; pressure < pores.pressure_nodes(); ++pressure)
    pressure_of[pores.node_of(pressure)] = pores.pressure_node(pressure);
  std::map<Index, Index> rotation_of;
  const auto& members = body_->members();
  for (std::size_t rotation = 0; rotation < members.rotation_nodes(); ++rotation)
    rotation_of[members.node_of(rotation)] = members.rotation_node(rotation);
  for (const auto& [node, leader] : supports_.tied) {
    tie(node, leader);
    if (pressure_of.contains(node) && pressure_of.contains(leader)) tie(pressure_of[node], pressure_of[leader]);
    if (rotation_of.contains(node) && rotation_of.contains(leader)) tie(rotation_of[node], rotation_of[leader]);
  }
}

template <int D>
std::optional<methods::fem::Freedom> FemStepper<D>::find_loose_freedom() {
  prepare_solver(true);
  methods::fem::LinearSolver<D> symmetric(body_->pattern(), unknowns_, true);
  symmetric.factorize(state_.tangent.values());
  prepare_solver(false);
  return symmetric.singular();
}

// The class is instantiated in stepper.cpp, without these.
#define SAZARE_INSTANTIATE(D) \
  template void FemStepper<D>::prepare_solver(bool); \
  template void FemStepper<D>::find_unknowns(bool); \
  template void FemStepper<D>::hold_sides(); \
  template void FemStepper<D>::find_leaders(); \
  template std::optional<Freedom> FemStepper<D>::find_loose_freedom();

SAZARE_INSTANTIATE(2)
SAZARE_INSTANTIATE(3)
#undef SAZARE_INSTANTIATE

}  // namespace sazare::methods::fem
