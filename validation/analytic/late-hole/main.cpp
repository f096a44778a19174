#include <algorithm>
#include <cmath>
#include <string>

#include "validation/common/blast.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

/// Fires the hole late, at a time that is no multiple of any step, beside blocks that are at rest until then.
void print_late(const std::string& name, const std::vector<std::string>& overrides, Real until) {
  auto model = validation::started_blast(overrides);
  auto& simulation = *model.simulation;
  int levels = 0;
  while (simulation.now().seconds() < until) {
    simulation.advance();
    const auto [lowest, highest] = validation::level_range(simulation);
    levels = std::max(levels, highest - lowest);
  }
  const auto balance = simulation.energy_balance();
  validation::print_row((name + "-residual").c_str(), std::abs(balance.residual()) / balance[terms::EnergyKind::work]);
  validation::print_row((name + "-broken").c_str(), model.joints->broken_count());
  validation::print_row((name + "-levels").c_str(), levels);
}

}  // namespace

int main() {
  print_late("stability", {"blasts.0.delay=1.23457e-4"}, 3e-4);
  print_late("travel",
             {"blasts.0.delay=7.12345e-6", "blasts.0.rise_time=1e-7", "blasts.0.decay_ratio=300", "time.limiter=\"travel\"",
              "time.base_step=2e-8", "time.travel_length=5e-8"},
             4e-5);
}
