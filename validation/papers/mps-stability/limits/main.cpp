#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sazare/methods/mps/run/limit_search.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
constexpr auto column = "cases/stability-study/column-s.toml";

runs::FoundLimit limit(Real spacing, const std::string& rotation = "mean_rotation", const std::string& torque = "half") {
  const std::vector<std::string> settings = {fmt::format("particles.spacing={}", spacing),
                                             fmt::format("particles.rotation=\"{}\"", rotation),
                                             fmt::format("particles.rotation_torque=\"{}\"", torque)};
  return runs::find_limit(registry::read_case(column, settings), {1.002, 20000, 1e3});
}

/// The largest ratio of the limits in runs of 2 s with three thresholds of divergence, R = 1.6 m, of two damping ratios.
Real by_threshold() {
  Real largest = 1;
  for (const Real damping : {0.001, 0.1}) {
    std::vector<Real> limits;
    for (const Real threshold : {2.2, 1e3, 1e15})
      limits.push_back(
          runs::find_limit(
              registry::read_case(column, std::vector<std::string>{"particles.spacing=3.2",
                                                                   fmt::format("materials.0.damping_ratio={}", damping)}),
              {1.01, 0, threshold})
              .limit());
    const auto [low, high] = std::ranges::minmax(limits);
    largest = std::max(largest, high / low);
  }
  return largest;
}

/// The limit with another upper layer over that of one material.
Real with_upper_layer(const std::string& setting) {
  const auto found = [](const std::vector<std::string>& settings) {
    constexpr auto layers = "validation/papers/mps-stability/limits/layers.toml";
    return runs::find_limit(registry::read_case(layers, settings), {1.01, 0, 1e15}).limit();
  };
  return found({setting}) / found({});
}

}  // namespace

int main() {
  parallel::set_threads(1);
  for (const auto& [name, spacing] : {std::pair{"05", 1.0}, {"10", 2.0}, {"16", 3.2}}) {
    const runs::FoundLimit found = limit(spacing);
    validation::print_row(fmt::format("predicted-{}", name).c_str(), found.predicted);
    validation::print_row(fmt::format("bisected-{}", name).c_str(), found.limit());
  }
  const runs::FoundLimit whole = limit(1.0, "mean_angle", "whole");
  validation::print_row("predicted-torque", whole.predicted);
  validation::print_row("bisected-torque", whole.limit());
  validation::print_row("paper-torque", whole.limit());
  validation::print_row("threshold", by_threshold());
  validation::print_row("density", with_upper_layer("materials.0.density=15000"));
  validation::print_row("poisson", with_upper_layer("materials.0.poisson_ratio=0.25"));
  validation::print_row("mean-angle", limit(1.0, "mean_angle").limit() / limit(1.0).limit());
}
