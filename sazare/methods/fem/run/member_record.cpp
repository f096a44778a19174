#include "sazare/methods/fem/run/member_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sazare/observe/column.hpp"

namespace sazare::runs {

template <int D>
MemberRecord<D>::MemberRecord(const methods::fem::FemStepper<D>& stepper)
    : stepper_(&stepper), yield_time_(stepper.body().members().sets().size(), -1) {}

template <int D>
bool MemberRecord<D>::has_force_limit(const Set& set) {
  return std::isfinite(set.yield_force) || set.compression_force;
}

template <int D>
bool MemberRecord<D>::has_moment_limit(const Set& set) {
  return std::isfinite(set.yield_moment);
}

template <int D>
methods::fem::MemberForces MemberRecord<D>::forces(std::size_t set) const {
  const auto& state = stepper_->state();
  return members().forces(set, state.displacement, state.velocity, state.memory.members);
}

template <int D>
void MemberRecord<D>::add_titles(std::vector<std::string>& history) const {
  for (const Set& set : members().sets()) {
    observe::add_titles(history, columns::fem::member, set.name);
    if (has_force_limit(set)) observe::add_titles(history, columns::fem::force_limit, set.name);
    if (has_moment_limit(set)) observe::add_titles(history, columns::fem::moment_limit, set.name);
  }
}

template <int D>
void MemberRecord<D>::add_values(std::vector<Real>& row) const {
  for (std::size_t i = 0; i < members().sets().size(); ++i) {
    const Set& set = members().sets()[i];
    const auto found = forces(i);
    row.insert(row.end(), {found.least_axial, found.largest_axial, found.shear, found.moment});
    if (has_force_limit(set)) row.insert(row.end(), {found.force_ratio(set), found.plastic_elongation});
    if (has_moment_limit(set)) row.insert(row.end(), {found.moment_ratio(set), found.plastic_rotation});
  }
}

template <int D>
void MemberRecord<D>::observe(Real time) {
  for (std::size_t i = 0; i < members().yielding(); ++i) {
    Real& first = yield_time_[members().set_of_yielding(i)];
    if (first < 0 && members().has_yielded(i, stepper_->state().memory.members)) first = time;
  }
}

template <int D>
std::vector<observe::CellData> MemberRecord<D>::fields() {
  std::vector<observe::CellData> fields;
  const std::size_t nodes = stepper_->body().mesh().nodes.size();
  elongation_.assign(nodes, 0);
  rotation_.assign(nodes, 0);
  for (std::size_t i = 0; i < members().yielding(); ++i)
    for (const auto& [node, plastic] : members().plastic_by_node(i, stepper_->state().memory.members)) {
      auto& field = has_moment_limit(members().sets()[members().set_of_yielding(i)]) ? rotation_ : elongation_;
      field[at(node)] = std::max(field[at(node)], plastic);
    }
  if (std::ranges::any_of(members().sets(), has_force_limit))
    fields.push_back(observe::cell_data(columns::fem::yielded[0].name, elongation_));
  if (std::ranges::any_of(members().sets(), has_moment_limit))
    fields.push_back(observe::cell_data(columns::fem::yielded[1].name, rotation_));
  return fields;
}

template <int D>
void MemberRecord<D>::add_results(std::vector<std::pair<std::string, observe::Figure>>& results) const {
  for (std::size_t i = 0; i < members().sets().size(); ++i) {
    const Set& set = members().sets()[i];
    if (yield_time_[i] >= 0) results.emplace_back("yield_time_" + set.name, yield_time_[i]);
    if (has_force_limit(set)) results.emplace_back("plastic_elongation_" + set.name, forces(i).plastic_elongation);
    if (has_moment_limit(set)) results.emplace_back("plastic_rotation_" + set.name, forces(i).plastic_rotation);
  }
}

template class MemberRecord<2>;
template class MemberRecord<3>;

}  // namespace sazare::runs
