#include <algorithm>

#include "validation/common/blast.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

Real step_of(const levels::Simulation<3>& simulation, Index body) {
  return simulation.levels().step(simulation.levels().level(body));
}

/// Share of the elements that step more often than the base step: where the wave and the fragments are.
Real shortened_share(const levels::Simulation<3>& simulation) {
  int count = 0;
  for (Index body = 0; body < simulation.bodies().size(); ++body) count += simulation.levels().level(body) > 0;
  return static_cast<Real>(count) / simulation.bodies().size();
}

/// Shortest step of the elements that are chosen [s].
template <class Choose>
Real shortest_step(const levels::Simulation<3>& simulation, Choose&& choose) {
  Real shortest = simulation.levels().step(0);
  for (Index body = 0; body < simulation.bodies().size(); ++body)
    if (choose(static_cast<std::size_t>(body))) shortest = std::min(shortest, step_of(simulation, body));
  return shortest;
}

}  // namespace

int main() {
  auto model = validation::started_blast({"time.limiter=\"travel\"", "time.base_step=1e-8", "time.travel_length=1e-8"});
  const auto& simulation = *model.simulation;
  const auto start = [&](std::size_t element) { return simulation.bodies().start[element]; };
  validation::advance_to(model, 5e-5);
  const Real early = shortened_share(simulation);
  validation::advance_to(model, 2.5e-4);
  const Real near = shortest_step(simulation, [&](std::size_t i) { return validation::distance_from_hole(model, i) < 0.1; });
  using validation::print_row;
  print_row("smallest", model.simulation->take_smallest_step());
  print_row("near-hole", near / shortest_step(simulation, [](std::size_t) { return true; }));
  print_row("right-side", shortest_step(simulation, [&](std::size_t i) { return start(i).x() > 1.7; }));
  print_row("far-left", shortest_step(simulation, [&](std::size_t i) { return start(i).x() < 0.2; }));
  print_row("spreads", shortened_share(simulation) / early);
}
