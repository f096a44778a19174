#include "sazare/methods/spheres/stepper/work_sums.hpp"

#include <type_traits>

#include "sazare/core/exact_vector.hpp"

namespace sazare::methods::spheres {

namespace {

static_assert(std::is_trivially_copyable_v<WorkSums>);

/// Calls `visit(name, number of each of the sums)`.
template <class Visit, class... Sums>
void visit_sums(Visit&& visit, Sums&... sums) {
  visit("dashpot_work", sums.dashpot_work...);
  visit("sliding_work", sums.sliding_work...);
  visit("bond_drag", sums.bond_drag...);
  visit("fracture", sums.fracture...);
  visit("wall_work", sums.wall_work...);
  visit("twice_water_work", sums.twice_water_work...);
  visit("twice_applied_work", sums.twice_applied_work...);
  visit("carried_energy", sums.carried_energy...);
  visit("broken_bonds", sums.broken...);
  visit("elastic", sums.elastic...);
  visit("sliding", sums.sliding...);
  visit("bond_energy", sums.bonds...);
  visit("water_work_now", sums.water_work_now...);
  visit("applied_work_now", sums.applied_work_now...);
  visit("contacts", sums.contacts...);
}

}  // namespace

WorkSums& WorkSums::operator+=(const WorkSums& more) {
  visit_sums([](const char*, auto& to, const auto& from) { to += from; }, *this, more);
  return *this;
}

void WorkSums::columns(Archive& archive) {
  visit_sums(
      [&]<class Sum>(const char* name, Sum& sum) {
        if constexpr (std::is_same_v<Sum, ExactSum>)
          exact_column(archive, name, sum);
        else
          archive(name, sum);
      },
      *this);
}

}  // namespace sazare::methods::spheres
