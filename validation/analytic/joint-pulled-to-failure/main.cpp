#include "tests/support/bonded_pair.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr Real fracture_energy = 99.67, failure_opening = 2 * fracture_energy / 6.66e6;

/// Two blocks that fly apart at 10 m/s and tear their joint, without dashpots: what their motion loses.
void print_dynamic(Real area) {
  auto blocks = test::two_block_case(true);
  blocks.joints[0].normal_damping = blocks.joints[0].shear_damping = 0;
  test::move(blocks, "left", {-5, 0, 0});
  test::move(blocks, "right", {5, 0, 0});
  blocks.time.base_step = 1e-9;
  auto model = runs::build_blocks(blocks, test::two_blocks());
  model.simulation->start();
  while (model.simulation->now().seconds() < 5e-6) model.simulation->advance();
  const auto balance = model.simulation->energy_balance();
  validation::print_row("broken", model.joints->broken_count());
  validation::print_row("kinetic", -balance[terms::EnergyKind::kinetic], fracture_energy * area);
  validation::print_row("energy-balance", balance[terms::EnergyKind::fracture], fracture_energy * area);
}

/// The joint is opened in small steps: its work is force times displacement, by the trapezoidal rule.
void print_static(Real area) {
  test::BondedPair pair;
  constexpr int steps = 20000;
  Real work = 0, before = 0, largest = 0;
  for (int step = 0; step <= steps; ++step) {
    pair.place(1.001 * failure_opening * step / steps);
    const Real stress = pair.stress().x();
    if (step > 0) work += 0.5 * (before + stress) * area * 1.001 * failure_opening / steps;
    largest = std::max(largest, stress);
    before = stress;
  }
  validation::print_row("work", work, fracture_energy * area);
  validation::print_row("strength", largest);
}

}  // namespace

int main() {
  const Real area = test::BondedPair().area();
  print_static(area);
  print_dynamic(area);
}
