#include <cmath>
#include <numbers>

#include "sazare/methods/fem/run/model.hpp"
#include "sazare/registry/registry.hpp"
#include "sazare/runs/temporary_folder.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
constexpr Real length = 10, height = 1, modulus = 3e10, density = 2400, traction = 1e5;

runs::FemModel<2> beam(const std::vector<std::string>& settings) {
  const auto file = registry::read_case("cases/cantilever-fem/case.toml", settings);
  const runs::TemporaryFolder folder;
  return runs::build_fem<2>(file, runs::load_fem_mesh(file, folder.path() / "mesh.msh", false));
}

/// Timoshenko's, with Cowper's shear coefficient for Poisson's ratio 0.
Real deflection() {
  const Real force = traction * height, inertia = height * height * height / 12, shear = modulus / 2;
  return force * length * length * length / (3 * modulus * inertia) + force * length / (10.0 / 12 * shear * height);
}

/// The first root b of the frequency equation of Timoshenko's cantilever, b^2 = rho A L^4 w^2/(E I): T. C. Huang, J. Appl. Mech.
/// 28 (1961) 579-584.
Real first_frequency() {
  const Real r2 = height * height / (length * length) / 12, s2 = 2 / (10.0 / 12) * r2;
  const auto equation = [&](Real b) {
    const Real root = std::sqrt((r2 - s2) * (r2 - s2) + 4 / (b * b));
    const Real alpha = b * std::sqrt(0.5 * (root - r2 - s2)), beta = b * std::sqrt(0.5 * (root + r2 + s2));
    return 2 + (b * b * (r2 - s2) * (r2 - s2) + 2) * std::cosh(alpha) * std::cos(beta) -
           b * (r2 + s2) / std::sqrt(1 - b * b * r2 * s2) * std::sinh(alpha) * std::sin(beta);
  };
  Real low = 3, high = 3.6;
  while (high - low > 1e-12) (equation(0.5 * (low + high)) * equation(low) > 0 ? low : high) = 0.5 * (low + high);
  return low / (2 * std::numbers::pi) * std::sqrt(modulus / density / 12) * height / (length * length);
}

}  // namespace

int main() {
  auto at_rest = beam({"time.analysis=\"static\""});
  at_rest.stepper->start();
  at_rest.stepper->advance();
  const auto tip = static_cast<std::size_t>(at_rest.gauges.front()) * 2 + 1;
  validation::print_row("deflection", -at_rest.stepper->state().displacement[tip] / deflection());

  // The load set on at once: the tip swings about its place at rest, through which it goes twice in a period.
  auto swings = beam({});
  swings.stepper->start();
  const Real rest = at_rest.stepper->state().displacement[tip];
  Real before = 0, lowest = 0, first = 0, last = 0;
  int crossings = 0;
  while (crossings < 7) {
    swings.stepper->advance();
    const Real now = swings.stepper->state().displacement[tip];
    lowest = std::min(lowest, now);
    if ((before - rest) * (now - rest) < 0) {
      const Real time = swings.stepper->time() - swings.step * (now - rest) / (now - before);
      (crossings == 0 ? first : last) = time;
      ++crossings;
    }
    before = now;
  }
  validation::print_row("frequency", 3 / (last - first) / first_frequency());
  validation::print_row("swing", lowest / rest);
}
