#include <cmath>
#include <string>

#include "tests/support/bonded_pair.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using methods::blocks::JointState;

constexpr Real cohesion = 6.66e6, fracture_energy = 99.67, shear_energy = 900, peak = 0.58, residual = 0.4;
constexpr Real failure_slip = 2 * shear_energy / cohesion, stiffness = 450e9;

cases::Joint mixed_joint() {
  cases::Joint joint = test::concrete_joint("left", "right");
  joint.law = laws::JointLawName::mixed_mode;
  joint.law_parameters = {shear_energy, residual};
  return joint;
}

/// Slides under a constant pressure [Pa] to beyond failure: work of the shear force, largest and last shear stress.
void print_direct_shear(Real pressure, const std::string& name) {
  test::BondedPair pair(mixed_joint());
  constexpr int steps = 20000;
  const Real last = 1.2 * failure_slip;
  Real work = 0, before = 0, largest = 0;
  for (int step = 0; step <= steps; ++step) {
    pair.place(-pressure / stiffness, last * step / steps);
    const Real stress = pair.stress().y();
    if (step > 0) work += 0.5 * (before + stress) * pair.area() * last / steps;
    largest = std::max(largest, stress);
    before = stress;
  }
  const Real strength = cohesion + peak * pressure, rest = residual * pressure;
  // The stress rises on the spring, falls on a straight line to the rest at the failure slip, and stays.
  const Real slipped = last - rest / 90e9;
  const Real expected = (0.5 * (strength + rest) * failure_slip + rest * (slipped - failure_slip) + 0.5 * rest * rest / 90e9) * pair.area();
  validation::print_row(("strength-" + name).c_str(), largest, strength);
  validation::print_row(("residual-" + name).c_str(), before, rest);
  validation::print_row(("work-" + name).c_str(), work, expected);
}

/// One block shoots along the other: what its motion loses to a joint without dashpots and friction.
void print_dynamic(Real area) {
  auto blocks = test::two_block_case(true);
  blocks.joints[0] = mixed_joint();
  blocks.joints[0].normal_damping = blocks.joints[0].shear_damping = 0;
  blocks.joints[0].friction_coefficient = 0;
  blocks.joints[0].law_parameters[1] = 0;
  blocks.constraints.push_back({{"left", "right"}, {true, false, false}, {true, true, true}});
  test::move(blocks, "left", {0, -5, 0});
  test::move(blocks, "right", {0, 5, 0});
  blocks.time.base_step = 1e-8;
  auto model = runs::build_blocks(blocks, test::two_blocks());
  model.simulation->start();
  while (model.simulation->now().seconds() < 4e-5) model.simulation->advance();
  const auto balance = model.simulation->energy_balance();
  validation::print_row("cracks", model.joints->broken_count());
  validation::print_row("kinetic", -balance[terms::EnergyKind::kinetic], shear_energy * area);
  validation::print_row("energy-balance", balance.residual() / (shear_energy * area));
}

/// Opening and slip in a fixed proportion, without friction: what each dissipates until the joint has no strength left.
void print_mixed(Real share, const std::string& name) {
  cases::Joint joint = mixed_joint();
  *joint.normal_stiffness *= 1e4;
  *joint.shear_stiffness *= 1e4;
  joint.friction_coefficient = 0;
  joint.law_parameters[1] = 0;
  test::BondedPair pair(joint);
  const Real failure_opening = 2 * fracture_energy / joint.tensile_strength;
  constexpr int steps = 20000;
  for (int step = 0; step <= steps && pair.joints().state(0) != JointState::broken; ++step) {
    const Real way = 1.01 * step / steps;
    pair.place(way * share * failure_opening, way * (1 - share) * failure_slip);
    pair.forces();
  }
  const auto& losses = pair.joints().losses(0);
  validation::print_row(("criterion-" + name).c_str(),
                        (losses.opening / fracture_energy + losses.shear / shear_energy) / pair.area());
}

}  // namespace

int main() {
  print_direct_shear(0, "free");
  print_direct_shear(5e6, "pressed");
  print_dynamic(test::BondedPair().area());
  print_mixed(0.25, "shear");
  print_mixed(0.75, "opening");
}
