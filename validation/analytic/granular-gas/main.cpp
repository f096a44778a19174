#include <cmath>
#include <numbers>

#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/parallel/threads.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr int across = 16;
constexpr Real radius = 5e-4, share = 0.05, restitution = 0.9, speed = 0.5, step = 1e-6;
constexpr int steps = 200000;

Real random_part(std::uint64_t& seed) {
  seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
  return static_cast<Real>(seed >> 11) / 4503599627370496.0 - 1;
}

/// Smooth spheres at random velocities in a box that is periodic on all sides, without total momentum.
state::Spheres gas() {
  const Real spacing = radius * std::cbrt(4 * std::numbers::pi / 3 / share);
  state::Spheres spheres;
  spheres.box.length = Vector3::Constant(spacing * across);
  std::uint64_t seed = 11;
  for (int k = 0; k < across; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) spheres.add(spacing * Vector3(i + 0.5, j + 0.5, k + 0.5), radius, 2500, 0);
  std::vector<Vector3> velocities(spheres.size());
  Vector3 mean = Vector3::Zero();
  for (Vector3& velocity : velocities) {
    for (Real& part : velocity) part = speed * random_part(seed);
    mean += velocity / static_cast<Real>(velocities.size());
  }
  for (std::size_t i = 0; i < velocities.size(); ++i) spheres.set_motion(i, velocities[i] - mean, Vector3::Zero());
  return spheres;
}

/// Energy per degree of freedom over the mass of a sphere [m2/s2].
Real temperature(methods::spheres::SphereStepper& stepper) {
  stepper.evaluate_now();
  const auto& spheres = stepper.spheres();
  return 2 * stepper.energies().translation / (3 * static_cast<Real>(spheres.size()) * spheres.place[0].mass);
}

}  // namespace

int main() {
  parallel::set_threads(1);
  methods::spheres::ContactTable table(laws::ContactModel::hertz, 1);
  const laws::GrainElasticity solid{1e9, 0.3};
  table.set(0, 0, laws::hertz_constants(solid, solid, restitution, {}));
  methods::spheres::SphereStepper stepper(gas(), table, {}, {step, Vector3::Zero(), radius, radius});
  stepper.start();
  // From a lattice and velocities in a cube the gas takes some collisions to forget how it began.
  for (int k = 0; k < steps / 10; ++k) stepper.advance();
  const Real first = temperature(stepper), begun = stepper.time();
  const Real density = share / (4 * std::numbers::pi / 3 * std::pow(radius, 3)), pair = (1 - share / 2) / std::pow(1 - share, 3);
  // Haff: T = T0/(1 + t/tau)^2, 1/tau = (1 - e^2) omega/6, omega = 4 sqrt(pi) n d^2 g sqrt(T0) collisions of a sphere per second.
  const Real rate = (1 - restitution * restitution) / 6 * 4 * std::sqrt(std::numbers::pi) * density * 4 * radius * radius * pair *
                    std::sqrt(first);
  for (int part = 1; part <= 2; ++part) {
    for (int k = 0; k < steps / 2; ++k) stepper.advance();
    const Real expected = 1 / std::pow(1 + rate * (stepper.time() - begun), 2);
    validation::print_row(part == 1 ? "half" : "whole", temperature(stepper) / first, expected);
  }
  validation::print_row("momentum", stepper.momentum().norm() /
                                        (static_cast<Real>(stepper.spheres().size()) * stepper.spheres().place[0].mass * speed));
}
