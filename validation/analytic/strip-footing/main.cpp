#include <cmath>

#include "sazare/methods/fem/case/case.hpp"
#include "sazare/methods/fem/run/model.hpp"
#include "sazare/registry/registry.hpp"
#include "sazare/runs/temporary_folder.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

/// Load of the footing over its width and the cohesion, at the end of the settlement.
Real bearing_factor(const std::vector<std::string>& settings) {
  const auto file = registry::read_case("cases/strip-footing/case.toml", settings);
  const runs::TemporaryFolder folder;
  auto model = runs::build_fem<2>(file, runs::load_fem_mesh(file, folder.path() / "mesh.msh", false));
  model.stepper->start();
  const auto steps = std::llround(file.as<cases::FemCase>().time.end / model.step);
  for (std::int64_t step = 0; step < steps; ++step) model.stepper->advance();
  Real force = 0;
  const auto reactions = model.stepper->reactions();
  for (const auto& support : model.stepper->supports().held)
    if (support.motion >= 0)
      force -= reactions[static_cast<std::size_t>(support.node) * 2 + static_cast<std::size_t>(support.axis)];
  return force / (0.5 * file.as<cases::FemCase>().materials.front().cohesion);
}

}  // namespace

int main() {
  const Real coarse = bearing_factor({"mesh.size_factor=2"}), fine = bearing_factor({});
  validation::print_row("bearing-factor", fine);
  validation::print_row("refined", (fine - 5.14159) / (coarse - 5.14159));
}
