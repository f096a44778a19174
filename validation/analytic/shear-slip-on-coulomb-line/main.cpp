#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/bonded_pair.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr Real cohesion = 6.66e6, friction = 0.58, normal_stiffness = 450e9, shear_stiffness = 90e9;

/// Largest distance from the Coulomb line while a face is dragged about under a changing normal stress, over the cohesion;
/// and the work of the path against what the balance has of it.
void print_walk() {
  test::BondedPair pair;
  Real worst = 0, work = 0, largest_stress = 0;
  Vector3 before = Vector3::Zero(), place = Vector3::Zero();
  constexpr int steps = 4000;
  for (int step = 0; step <= steps; ++step) {
    const Real turn = 4 * step * std::numbers::pi / steps;
    const Vector3 next(-1e-5 + 1.2e-5 * std::sin(turn), 3e-4 * (1 - std::cos(turn)), 2e-4 * std::sin(2 * turn));
    pair.place(next.x(), next.y(), next.z());
    const Vector3 stress = pair.stress();
    const Real strength = std::max(0.0, cohesion - friction * normal_stiffness * next.x());
    worst = std::max(worst, (stress.tail<2>().norm() - strength) / cohesion);
    largest_stress = std::max(largest_stress, stress.tail<2>().norm() / strength);
    work += 0.5 * (before + stress).dot(next - place) * pair.area();
    before = stress;
    place = next;
  }
  const auto balance = pair.probe().energy_balance();
  validation::print_row("line", worst);
  validation::print_row("reached", largest_stress);
  const Real held = balance[terms::EnergyKind::slip] + balance[terms::EnergyKind::elastic] + balance[terms::EnergyKind::fracture];
  validation::print_row("work", held, work);
}

}  // namespace

int main() {
  print_walk();
  for (const Real n : {-2e-5, 0.0, 1.2e-5}) {
    test::BondedPair pair;
    pair.place(n, 1.5e-4, -2e-4);
    const char* row = n < 0 ? "compressed" : n > 0 ? "opened" : "unloaded";
    validation::print_row(row, pair.stress().tail<2>().norm(), cohesion - friction * normal_stiffness * n);
  }
  test::BondedPair pair;
  const Real limit = cohesion / shear_stiffness;
  pair.place(0, 3 * limit);
  pair.forces();
  validation::print_row("slip", pair.probe().energy_balance()[terms::EnergyKind::slip], cohesion * 2 * limit * pair.area());
}
