#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sazare/methods/spheres/stepper/stepper.hpp"
#include "sazare/parallel/threads.hpp"
#include "validation/common/rows.hpp"

namespace {

using namespace sazare;
using methods::spheres::ContactTable, methods::spheres::SphereStepper, methods::spheres::Wall;

constexpr Real pi = std::numbers::pi, radius = 0.01;

void print_row(const std::string& row, Real ours, Real expected) { validation::print_row(row.c_str(), ours, expected); }

struct Solid {
  std::string name;
  laws::GrainElasticity elasticity;
  Real density, surface_energy;

  /// E.
  Real modulus() const {
    return elasticity.youngs_modulus / (2 * (1 - elasticity.poisson_ratio * elasticity.poisson_ratio));
  }
  Real pull_off(Real reduced_radius) const { return 1.5 * pi * surface_energy * reduced_radius; }
  Real neck(Real reduced_radius) const {
    return 0.75 * std::cbrt(std::pow(pi * surface_energy / modulus(), 2) * reduced_radius);
  }
  Real loss(Real reduced_radius) const {
    const Real first = std::cbrt(2 * pi * surface_energy * reduced_radius * reduced_radius / modulus()),
               last = first / std::cbrt(16);
    return pi * surface_energy * (0.4 * last * last + 0.6 * first * first);
  }
  ContactTable table() const {
    ContactTable contacts(laws::ContactModel::jkr, 1);
    contacts.set(0, 0, laws::Jkr::constants({elasticity, elasticity, 1, {}}, {surface_energy}));
    return contacts;
  }
};

/// A wall that moves away from a held sphere, which it begins to touch, to twice the length of the neck.
void pull(const Solid& solid, bool of_triangles) {
  const Real neck = solid.neck(radius), step = 1e-6;
  constexpr int steps = 20000;
  laws::GroundMotion motion;
  motion.shape = laws::GroundMotion::Shape::sine;
  motion.quantity = laws::MotionQuantity::displacement;
  motion.amplitude = 2 * neck;
  motion.sine_wave = {1 / (4 * steps * step), 0};
  Wall ceiling;
  ceiling.normal = -Vector3::UnitZ();
  if (of_triangles) ceiling.triangles = {{Vector3(-1, -1, 0), Vector3(1, -1, 0), Vector3(0, 2, 0)}};
  ceiling.motion.histories = {{2, motion}};
  state::Spheres spheres;
  spheres.add(Vector3(0, 0, -radius + 1e-9 * neck), radius, solid.density, 0);
  spheres.kick[0].inverse_mass = spheres.kick[0].inverse_inertia = 0;
  SphereStepper stepper(std::move(spheres), solid.table(), {ceiling}, {step, Vector3::Zero(), radius, radius});
  stepper.start();
  Real largest = 0, longest = 0;
  for (int k = 0; k < steps && stepper.contacts() > 0; ++k) {
    longest = 2 * neck * std::sin(0.5 * pi * k / steps);
    largest = std::max(largest, -stepper.walls().loads()[0].force.z());
    stepper.advance();
    stepper.evaluate_now();
  }
  const std::string row = (of_triangles ? "mesh-" : "plane-") + solid.name;
  print_row(row + "-force", largest, solid.pull_off(radius));
  print_row(row + "-length", longest, neck);
  print_row(row + "-work", stepper.energies().wall_work, solid.loss(radius));
}

/// Two spheres that meet at some times the speed below which they stick.
void collide(const Solid& solid, Real times) {
  const Real reduced_radius = 0.5 * radius, mass = 0.5 * solid.density * 4 * pi / 3 * std::pow(radius, 3),
             sticking = std::sqrt(2 * solid.loss(reduced_radius) / mass), speed = times * sticking,
             apart = 0.1 * solid.neck(reduced_radius);
  state::Spheres spheres;
  for (const Real side : {-1.0, 1.0}) {
    spheres.add(Vector3(side * (radius + apart), 0, 0), radius, solid.density, 0);
    spheres.set_motion(spheres.size() - 1, Vector3(-0.5 * side * speed, 0, 0), Vector3::Zero());
  }
  const Real lasts = 20 * std::pow(mass * mass / (reduced_radius * solid.modulus() * solid.modulus() * speed), 0.2);
  SphereStepper stepper(std::move(spheres), solid.table(), {}, {lasts / 400000, Vector3::Zero(), radius, radius});
  stepper.start();
  for (int k = 0; k < 400000; ++k) stepper.advance();
  stepper.evaluate_now();
  const Real after = stepper.contacts() > 0 ? 0 : (stepper.velocity(1) - stepper.velocity(0)).norm();
  print_row(fmt::format("{}-{}", solid.name, times), after / sticking, std::sqrt(std::max(times * times - 1, Real{0})));
}

}  // namespace

int main() {
  parallel::set_threads(1);
  const Solid gelatine{"gelatine", {3e5, 0.49}, 1000, 0.2}, clay{"clay", {1e8, 0.3}, 2000, 5};
  for (const Solid& solid : {gelatine, clay}) {
    for (const bool of_triangles : {false, true}) pull(solid, of_triangles);
    for (const Real times : {0.9, 1.1, 3.0}) collide(solid, times);
  }
}
