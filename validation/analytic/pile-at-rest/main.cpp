#include <algorithm>
#include <cmath>

#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/parallel/threads.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;

constexpr Real radius = 0.005, gravity = 9.81, step = 1e-5, side = 0.06;

/// A bowl of triangles: a floor and four walls, each of two.
methods::spheres::Wall tray() {
  methods::spheres::Wall wall;
  const auto square = [&](const Vector3& corner, const Vector3& along, const Vector3& up) {
    wall.triangles.push_back({corner, corner + along, corner + along + up});
    wall.triangles.push_back({corner, corner + along + up, corner + up});
  };
  const Vector3 x(side, 0, 0), y(0, side, 0), z(0, 0, 0.2);
  square(Vector3::Zero(), x, y);
  square(Vector3::Zero(), x, z);
  square(Vector3::Zero(), y, z);
  square(y, x, z);
  square(x, y, z);
  return wall;
}

}  // namespace

int main() {
  parallel::set_threads(1);
  state::Spheres spheres;
  std::uint64_t seed = 3;
  const auto random = [&] {
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return 1e-3 * (static_cast<Real>(seed >> 11) / 4503599627370496.0 - 1);
  };
  for (int k = 0; k < 6; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const Real shift_x = random(), shift_y = random();
        spheres.add(Vector3(0.0113 + 0.0125 * i + shift_x, 0.0113 + 0.0125 * j + shift_y, 0.006 + 0.0125 * k), radius, 2500, 0);
      }
  methods::spheres::ContactTable table(laws::ContactModel::hertz, 1);
  const laws::GrainElasticity solid{1e7, 0.3};
  table.set(0, 0, laws::hertz_constants(solid, solid, 0.3, {0.5, 0.1, 0.05}));
  methods::spheres::SphereStepper stepper(std::move(spheres), table, {tray()}, {step, Vector3(0, 0, -gravity), 1e-3, 5e-3});
  stepper.start();
  for (int k = 0; k < 300000; ++k) stepper.advance();
  stepper.evaluate_now();
  const auto energies = stepper.energies();
  validation::print_row("kinetic", (energies.translation + energies.rotation) / energies.potential);
  Real outside = 0;
  for (const auto& place : stepper.spheres().place)
    for (const Real gap : {place.x, place.y, place.z, side - place.x, side - place.y})
      outside = std::max(outside, (radius - gap) / radius);
  validation::print_row("overlap", outside);
  const Real height = energies.potential;
  for (int k = 0; k < 100000; ++k) stepper.advance();
  stepper.evaluate_now();
  validation::print_row("creep", std::abs(stepper.energies().potential - height) / height);
  Real weight = 0;
  for (const auto& place : stepper.spheres().place) weight += place.mass * gravity;
  validation::print_row("weight", -stepper.walls().loads().front().force.z(), weight);
}
