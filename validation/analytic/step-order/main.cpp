#include <algorithm>
#include <cmath>

#include "tests/support/networks.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr Real end = 1.28;
constexpr int coarse_steps = 256;

enum class Levels { one, mixed };

/// Damping of the dashpot beside each spring, over the spring's stiffness [s].
struct Damping {
  Real time = 0;
};

/// A ladder of turning bodies and springs at the end; with mixed levels the base step's fraction of the limit falls with it,
/// so that every body keeps its level.
template <int D>
levels::Snapshot<D> state_at_end(Levels levels, Damping damping, int base_steps) {
  levels::StepRules rules;
  rules.base_step = end / base_steps;
  rules.stability = levels == Levels::mixed;
  rules.stability_fraction = 0.1 * 32 / base_steps;
  auto network = test::ladder<D>();
  for (auto& spring : network.springs) spring.damping = damping.time * spring.stiffness;
  auto simulation = network.simulation(rules);
  simulation.start();
  test::run(simulation, base_steps);
  return simulation.snapshot();
}

template <int D>
Real observed_order(Levels levels, Damping damping = {}) {
  const auto exact = state_at_end<D>(Levels::one, damping, 256 * coarse_steps);
  const Real coarse = test::distance(state_at_end<D>(levels, damping, coarse_steps), exact);
  const Real fine = test::distance(state_at_end<D>(levels, damping, 2 * coarse_steps), exact);
  return std::log2(coarse / fine);
}

template <int D>
Real level_difference() {
  levels::StepRules rules;
  rules.base_step = end / coarse_steps;
  rules.stability_fraction = 0.1 * 32 / coarse_steps;
  auto simulation = test::ladder<D>().simulation(rules);
  simulation.start();
  const auto [lowest, highest] = test::level_range(simulation);
  return highest - lowest;
}

}  // namespace

int main() {
  using validation::print_row;
  print_row("plane-one-level", observed_order<2>(Levels::one));
  print_row("plane-mixed", observed_order<2>(Levels::mixed));
  print_row("space-one-level", observed_order<3>(Levels::one));
  print_row("space-mixed", observed_order<3>(Levels::mixed));
  print_row("levels", std::min(level_difference<2>(), level_difference<3>()));
  constexpr Damping damping{0.02};
  print_row("damped-one-level", observed_order<3>(Levels::one, damping));
  print_row("damped-mixed", observed_order<3>(Levels::mixed, damping));
}
