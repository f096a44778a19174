#pragma once

/// Small bodies of spheres for the tests.

#include "sazare/methods/spheres/stepper/stepper.hpp"

namespace sazare::methods::spheres {

inline constexpr laws::GrainElasticity soft{1e8, 0.3};

struct Grain {
  Vector3 centre = Vector3::Zero();    ///< [m]
  Real radius = 0.01;                  ///< [m]
  Vector3 velocity = Vector3::Zero();  ///< [m/s]
  Vector3 spin = Vector3::Zero();      ///< [rad/s]
};

struct Rules {
  Real restitution = 1, friction = 0, rolling = 0, twisting = 0;
  Real step = 1e-6;
  Vector3 gravity = Vector3::Zero();
  Real margin = 1e-3;
  laws::ContactModel model = laws::ContactModel::hertz;
  state::PeriodicBox box = {};
  std::vector<std::int8_t> level = {};  ///< by grain; empty: all in one step
  Real surface_energy = 0;              ///< of model jkr [J/m2]
};

ContactTable table(const Rules& rules);
methods::spheres::SphereStepper make_stepper(const std::vector<Grain>& grains, const Rules& rules, std::vector<Wall> walls = {});

/// A heap of some hundred spheres of several sizes that fall into each other.
std::vector<Grain> heap(int across, Real speed, Real spacing = 0.021);

/// Levels of grains whose steps grow with their radius; the largest radius has level 0.
std::vector<std::int8_t> levels_by_radius(const std::vector<Grain>& grains);

/// Where the sphere with a number stands in memory.
std::size_t place_of(const methods::spheres::SphereStepper& stepper, Index number);

inline Vector3 centre_of(const methods::spheres::SphereStepper& stepper, Index number) {
  return stepper.spheres().place[place_of(stepper, number)].centre();
}
inline Vector3 velocity_of(const methods::spheres::SphereStepper& stepper, Index number) {
  return stepper.velocity(place_of(stepper, number));
}
inline Vector3 spin_of(const methods::spheres::SphereStepper& stepper, Index number) { return stepper.spin(place_of(stepper, number)); }

inline void advance(methods::spheres::SphereStepper& stepper, int steps) {
  for (int step = 0; step < steps; ++step) stepper.advance();
  stepper.evaluate_now();
}

}  // namespace sazare::methods::spheres
