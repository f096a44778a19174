#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sazare/methods/mps/run/model.hpp"
#include "sazare/methods/mps/run/limit_search.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
namespace mps = methods::mps;

/// To the end of the case: what a run of 2 s bears, as in the paper. With a damping force that is given, in 20 000 steps.
Real limit(const std::string& integrator, Real spacing, Real damping, const std::string& euler_damping = "") {
  std::vector<std::string> settings = {fmt::format("particles.spacing={}", spacing),
                                       fmt::format("time.integrator=\"{}\"", integrator),
                                       fmt::format("materials.0.damping_ratio={}", damping)};
  if (!euler_damping.empty()) settings.push_back(fmt::format("time.euler_damping=\"{}\"", euler_damping));
  const runs::LimitRules rules = euler_damping.empty() ? runs::LimitRules{1.02, 0, 1e15} : runs::LimitRules{1.005, 20000, 1e3};
  return runs::find_limit(registry::read_case("cases/stability-study/column-s.toml", settings), rules).limit();
}

constexpr std::array ratios{0.001, 0.0022, 0.0048, 0.01, 0.022, 0.048, 0.1, 0.22, 0.48, 1.0};  // Table 1

mps::StableStep prediction(Real spacing, Real damping) {
  const std::vector<std::string> settings = {fmt::format("particles.spacing={}", spacing),
                                             fmt::format("materials.0.damping_ratio={}", damping)};
  return runs::make_parts<2>(registry::read_case("cases/stability-study/column-s.toml", settings)).predict();
}

/// The ratio of Table 1 with the largest predicted limit of Euler, its damping force lagged.
Real best_ratio(Real spacing) {
  return *std::ranges::max_element(ratios, {}, [&](Real ratio) { return prediction(spacing, ratio).euler_lagged; });
}

/// The largest limit of Euler, its damping force lagged, over that of Verlet.
Real lagged_over_verlet() {
  Real largest = 0;
  for (const Real spacing : {1.0, 3.2})
    for (const Real ratio : ratios) {
      const auto found = prediction(spacing, ratio);
      largest = std::max(largest, found.euler_lagged / found.verlet);
    }
  return largest;
}

/// Verlet's predicted limit over Euler's, h = 1.
Real predicted(Real spacing) {
  const auto found = prediction(spacing, 1);
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
  validation::print_row("lagged-05-peak", best_ratio(1));
  validation::print_row("lagged-16-peak", best_ratio(3.2));
  validation::print_row("lagged-below-verlet", lagged_over_verlet());
  validation::print_row("lagged-05", limit("euler", 1, 0.1, "lagged"), prediction(1, 0.1).euler_lagged);
  validation::print_row("lagged-16", limit("euler", 3.2, 0.48, "lagged"), prediction(3.2, 0.48).euler_lagged);
}
