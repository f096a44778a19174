#include <fmt/format.h>

#include "sazare/methods/mps/run/limit_search.hpp"
#include "sazare/parallel/threads.hpp"
#include "sazare/registry/registry.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
constexpr auto column = "cases/stability-study/column-s.toml";

runs::FoundLimit limit(Real spacing, const std::string& rotation = "mean_rotation") {
  const std::vector<std::string> settings = {fmt::format("particles.spacing={}", spacing),
                                             fmt::format("particles.rotation=\"{}\"", rotation)};
  return runs::find_limit(registry::read_case(column, settings), {1.002, 20000, 1e3});
}

}  // namespace

int main() {
  parallel::set_threads(1);
  for (const auto& [name, spacing] : {std::pair{"05", 1.0}, {"10", 2.0}, {"16", 3.2}}) {
    const runs::FoundLimit found = limit(spacing);
    validation::print_row(fmt::format("predicted-{}", name).c_str(), found.predicted);
    validation::print_row(fmt::format("bisected-{}", name).c_str(), found.limit());
  }
  validation::print_row("mean-angle", limit(1.0, "mean_angle").limit() / limit(1.0).limit());
}
