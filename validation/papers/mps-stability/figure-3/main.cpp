#include <fmt/format.h>

#include <cmath>

#include "sazare/methods/mps/run/model.hpp"
#include "sazare/methods/mps/run/limit_search.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

/// To the end of the case: what a run of 2 s bears, as in the paper.
Real limit(const std::string& integrator, Real spacing, Real damping) {
  const std::vector<std::string> settings = {fmt::format("particles.spacing={}", spacing),
                                             fmt::format("time.integrator=\"{}\"", integrator),
                                             fmt::format("materials.0.damping_ratio={}", damping)};
  return runs::find_limit(registry::read_case("cases/stability-study/column-s.toml", settings), {1.02, 0, 1e15}).limit();
}

/// Verlet's predicted limit over Euler's, h = 1.
Real predicted(Real spacing) {
  const std::vector<std::string> settings = {fmt::format("particles.spacing={}", spacing), "materials.0.damping_ratio=1"};
  const auto found = runs::make_parts<2>(registry::read_case("cases/stability-study/column-s.toml", settings)).predict();
  return found.verlet / found.euler;
}

}  // namespace

int main() {
  parallel::set_threads(1);
  Real farthest = 1;
  for (const Real damping : {0.001, 0.1, 1.0}) {
    const Real ratio = limit("leapfrog", 1, damping) / limit("verlet", 1, damping);
    if (std::abs(ratio - 1) >= std::abs(farthest - 1)) farthest = ratio;
  }
  validation::print_row("leapfrog", farthest);
  const Real high_05 = limit("verlet", 1, 1.0) / limit("euler", 1, 1.0);
  const Real high_16 = limit("verlet", 3.2, 1.0) / limit("euler", 3.2, 1.0);
  validation::print_row("euler-high", std::sqrt(high_05 * high_16));
  validation::print_row("euler-05-high", high_05, predicted(1));
  validation::print_row("euler-16-high", high_16, predicted(3.2));
}
