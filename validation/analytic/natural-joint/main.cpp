#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/bonded_pair.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr Real degree = std::numbers::pi / 180;
constexpr Real jrc = 10, jcs = 100e6, residual_angle = 30, length = 0.1, aperture = 0.3e-3, damage = 2, stiffness = 450e9;
const Real peak_slip = length / 500 * std::cbrt(jrc / length);

cases::Joint natural_joint(Real roughness = jrc) {
  cases::Joint joint = test::concrete_joint("left", "right");
  joint.law = laws::JointLawName::barton_bandis;
  joint.cohesion = joint.friction_coefficient = joint.tensile_strength = joint.fracture_energy = 0;
  joint.normal_damping = joint.shear_damping = 0;
  laws::BartonBandis::Own own{roughness, jcs, residual_angle, length, std::nullopt, aperture};
  if (roughness == 0) own[laws::BartonBandis::joint_aperture] = std::nullopt;  // beyond what the estimate is for
  std::ranges::copy(own, joint.law_parameters.end() - own.size());
  return joint;
}

/// What roughness adds to the friction angle at the peak [rad].
Real roughness_angle(Real pressure) { return jrc * std::log10(jcs / pressure) * degree; }

Real barton(Real pressure, Real share) {
  return pressure * std::tan(residual_angle * degree + share * roughness_angle(pressure));
}

/// The table of mobilised roughness, by the slip over that of the peak, up to 10.
Real mobilised(Real x) {
  if (x < 0.3) return 0;
  if (x < 0.6) return 0.75 * (x - 0.3) / 0.3;
  if (x < 1) return 0.75 + 0.25 * (x - 0.6) / 0.4;
  if (x < 2) return 1 - 0.15 * (x - 1);
  if (x < 4) return 0.85 - 0.15 * (x - 2) / 2;
  return 0.7 - 0.2 * (x - 4) / 6;
}

/// The integral of a function of the slip up to some slip.
template <class F>
Real integral(Real to, F&& f) {
  constexpr int parts = 20000;
  Real sum = 0;
  for (int n = 0; n < parts; ++n) sum += f((n + 0.5) * to / parts);
  return sum * to / parts;
}

/// Compression [m] of springs and joint under a pressure, by the formulas in MPa and mm.
Real compression(Real pressure) {
  const Real initial = -7.15 + 1.75 * jrc + 0.02 * (1e-6 * jcs) / (1e3 * aperture);
  const Real most = -0.2960 - 0.0056 * jrc + 2.2410 * std::pow(1e-6 * jcs / (1e3 * aperture), -0.2450);
  return pressure / stiffness + 1e-3 / (1 / most + initial / (1e-6 * pressure));
}

struct Sheared {
  Real largest = 0, last = 0;   ///< shear stress [Pa]
  Real slip = 0, dilation = 0;  ///< [m]
};

/// Slides under a constant pressure up to so many times the slip of the peak.
Sheared shear(Real pressure, Real times) {
  test::BondedPair pair(natural_joint());
  const int steps = static_cast<int>(5000 * times);
  Sheared found;
  for (int step = 1; step <= steps; ++step) {
    pair.place(pair.joints().record(0).vertex[0].peak - compression(pressure), times * peak_slip * step / steps);
    found.last = pair.stress().y();
    found.largest = std::max(found.largest, found.last);
  }
  found.slip = pair.joints().slip_paths()[0][0];
  found.dilation = pair.joints().record(0).vertex[0].peak;
  return found;
}

void print_direct_shear() {
  for (const auto& [pressure, name] : {std::pair{0.3e6, "0.3"}, {1e6, "1"}, {3e6, "3"}, {10e6, "10"}})
    validation::print_row((std::string("peak-") + name).c_str(), shear(pressure, 1.1).largest, barton(pressure, 1));
  const Sheared worn = shear(1e6, 10);
  validation::print_row("worn", worn.last, barton(1e6, 0.5));
  const Sheared lifted = shear(1e6, 2);
  const Real expected =
      integral(lifted.slip, [](Real slip) { return std::tan(mobilised(slip / peak_slip) * roughness_angle(1e6) / damage); });
  validation::print_row("dilation", lifted.dilation, expected);
}

void print_closure() {
  for (const auto& [pressure, name] : {std::pair{1e6, "1"}, {10e6, "10"}}) {
    test::BondedPair pair(natural_joint());
    pair.place(-compression(pressure));
    validation::print_row((std::string("closure-") + name).c_str(), -pair.stress().x(), pressure);
  }
}

/// Slow, and at 0.5 m/s, at which its dashpot alone would bear 5 MPa.
void print_plane_joint() {
  cases::Joint joint = natural_joint(0);
  joint.shear_damping = 10.1e6;
  test::BondedPair pair(joint);
  pair.place(-1e-5);
  const Real pressure = -pair.stress().x();
  pair.place(-1e-5, 1e-3);
  validation::print_row("plane", pair.stress().y() / pressure, std::tan(residual_angle * degree));
  pair.bodies().motion[1].velocity = Vector3(0, 0.5, 0);
  validation::print_row("damped", pair.stress().y() / pressure, std::tan(residual_angle * degree));
}

std::size_t place_of_aperture() {
  return laws::parameters_of_laws<laws::JointLaws>.size() - laws::BartonBandis::parameters.size() +
         laws::BartonBandis::joint_aperture;
}

/// A block slides on another, which is held, under a pressure of 1 MPa by its weight, until it stands. Dilation makes it hop, so
/// that its way is not that of a constant pressure; its energy must be accounted for.
void print_sliding_block(const char* row, bool closes) {
  constexpr Real pressure = 1e6, speed = 10;
  auto blocks = test::two_block_case(true);
  blocks.joints[0] = natural_joint();
  if (!closes) blocks.joints[0].law_parameters[place_of_aperture()] = std::nullopt;
  const Real area = test::BondedPair(natural_joint()).area(), mass = 2390 * std::pow(0.1, 3) / (6 * std::sqrt(2.0));
  blocks.gravity.acceleration = Vector3(-pressure * area / mass, 0, 0);
  blocks.initial_stress.normal = Vector3(-pressure, 0, 0);
  blocks.constraints.push_back({{"left"}, {true, true, true}, {true, true, true}});
  blocks.constraints.push_back({{"right"}, {false, false, true}, {true, true, true}});
  test::move(blocks, "right", {0, speed, 0});
  blocks.time.base_step = 1e-8;
  auto model = runs::build_blocks(blocks, test::two_blocks());
  model.simulation->start();
  const auto& right = model.simulation->bodies().motion[1];
  while (right.velocity.y() > 0 && model.simulation->now().seconds() < 2e-3) model.simulation->advance();
  const Real energy = 0.5 * mass * speed * speed;
  validation::print_row(row, std::abs(model.simulation->energy_balance().residual()) / energy);
}

}  // namespace

int main() {
  print_direct_shear();
  print_closure();
  print_plane_joint();
  print_sliding_block("energy-balance", true);
  print_sliding_block("energy-balance-stiff", false);
}
