#include <algorithm>
#include <cmath>

#include "tests/support/bonded_pair.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr Real stiffness = 450e9, strength = 6.66e6, fracture_energy = 99.67;
constexpr Real elastic_opening = strength / stiffness, failure_opening = 2 * fracture_energy / strength;

Real envelope(Real opening) {
  if (opening <= elastic_opening) return stiffness * opening;
  return strength * (failure_opening - opening) / (failure_opening - elastic_opening);
}

}  // namespace

int main() {
  test::BondedPair pair;
  Real unloading = 0, reloading = 0, loading = 0, cycle = 0;
  for (const Real share : {0.55, 0.65, 0.8, 0.95}) {  // of the failure opening; softening begins at 0.49
    const Real peak = share * failure_opening;
    pair.place(peak);
    loading = std::max(loading, std::abs(pair.stress().x() - envelope(peak)) / strength);
    const Real fracture = pair.probe().energy_balance()[terms::EnergyKind::fracture];
    for (int i = 20; i >= 0; --i) {
      pair.place(peak * i / 20);
      unloading = std::max(unloading, std::abs(pair.stress().x() - envelope(peak) * i / 20) / strength);
    }
    for (int i = 0; i <= 20; ++i) {
      pair.place(peak * i / 20);
      reloading = std::max(reloading, std::abs(pair.stress().x() - envelope(peak) * i / 20) / strength);
    }
    cycle = std::max(cycle, std::abs(pair.probe().energy_balance()[terms::EnergyKind::fracture] - fracture));
  }
  pair.place(-1e-5);
  validation::print_row("loading", loading);
  validation::print_row("unloading", unloading);
  validation::print_row("reloading", reloading);
  validation::print_row("cycle", cycle);
  validation::print_row("compression", pair.stress().x(), -1e-5 * stiffness);
}
