#include <gtest/gtest.h>

#include <cmath>

#include "sazare/methods/rectangles/contacts.hpp"
#include "tests/support/blocks_of_squares.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::rectangles {
namespace {

using geometry::OutlineKind, geometry::Vector2;
using test::Scene;

/// A block on an incline of a given angle, gravity straight down the screen turned instead.
Scene block_on_slope(Real slope, Real friction, Real half_width = 0.5, Real half_height = 0.5, Real damping_ratio = 1) {
  Scene scene;
  scene.contact = {1e8, 1e8, damping_ratio, friction, 1};
  scene.add(OutlineKind::rectangle, {0, half_height}, half_width, half_height);
  scene.add_wall({-100, 0}, {100, 0});
  scene.supports.gravity = 9.81 * Vector2(std::sin(slope), -std::cos(slope));
  return scene;
}

TEST(contacts, a_block_slides_as_coulomb_says) {
  const Real slope = 0.7, friction = 0.5;
  Scene scene = block_on_slope(slope, friction);
  auto stepper = scene.make(2e-5);
  stepper->start();
  while (stepper->time() < 0.2) stepper->advance();  // until it has settled
  const Real time = stepper->time(), place = stepper->particles().displacement[0][0], velocity = stepper->velocity()[0][0];
  while (stepper->time() < 0.6) stepper->advance();
  const Real after = stepper->time() - time, exact = 0.5 * 9.81 * (std::sin(slope) - friction * std::cos(slope)) * after * after;
  EXPECT_NEAR(stepper->particles().displacement[0][0] - place - velocity * after, exact, 1e-6 * exact);
  EXPECT_NEAR(stepper->particles().angle[0], 0, 1e-4);
}

TEST(contacts, a_block_stays_below_the_friction_angle) {
  Scene scene = block_on_slope(std::atan(0.5) - 0.01, 0.5);
  auto stepper = scene.make(2e-5);
  stepper->start();
  while (stepper->time() < 0.5) stepper->advance();
  EXPECT_LT(std::abs(stepper->particles().velocity[0][0]), 1e-6);
}

TEST(contacts, a_slender_block_topples_beyond_its_diagonal_and_not_before) {
  for (const Real excess : {-0.02, 0.02}) {
    Scene scene = block_on_slope(std::atan(0.25) + excess, 2, 0.25, 1);
    auto stepper = scene.make(2e-5);
    stepper->start();
    while (stepper->time() < 2) stepper->advance();
    if (excess > 0)
      EXPECT_LT(stepper->particles().angle[0], -0.3);
    else
      EXPECT_NEAR(stepper->particles().angle[0], 0, 1e-3);
  }
}

TEST(contacts, a_tumbling_block_closes_its_energy_balance) {
  Scene scene;
  scene.contact = {1e8, 1e8, 0.05, 0.5, 1};
  scene.add(OutlineKind::rectangle, {0, 2}, 0.5, 0.3, 0.4);
  scene.add(OutlineKind::rectangle, {0.3, 3.5}, 0.5, 0.5, 0.9, 1);
  scene.add_wall({-10, 0}, {10, 0});
  scene.supports.gravity = {0, -9.81};
  const auto energy = [](particles::UniformStepper<2>& stepper, const RectangleForces& forces) {
    Real total = stepper.kinetic_energy();
    const auto& particles = stepper.particles();
    for (std::size_t i = 0; i < 2; ++i) total += 9.81 / particles.inverse_mass[i] * particles.position(1, i);
    const EnergyParts energies = forces.energy_parts(particles);
    return total + energies.elastic + energies.lost();
  };
  auto stepper = scene.make(1e-5);
  stepper->start();
  const Real before = energy(*stepper, *scene.forces);
  while (stepper->time() < 2) stepper->advance();
  EXPECT_GT(scene.forces->contacts().touching(), 0);
  EXPECT_NEAR(energy(*stepper, *scene.forces), before, 5e-3 * before);
}

TEST(contacts, two_free_squares_that_meet_keep_their_momentum) {
  Scene scene;
  scene.contact = {1e8, 1e8, 0, 0.5, 1};
  scene.add(OutlineKind::rectangle, {0, 0}, 0.5, 0.5, 0.3);
  scene.add(OutlineKind::rectangle, {1.2, 0.4}, 0.5, 0.5, 0.8, 1);
  scene.make(1e-5);
  scene.particles().velocity[0][0] = 2;
  scene.particles().velocity[2][1] = 1;
  auto stepper = scene.make(1e-5);
  const auto& particles = stepper->particles();
  const auto angular = [&] {
    Real sum = 0;
    for (std::size_t i = 0; i < 2; ++i)
      sum += (particles.position(0, i) * particles.velocity[1][i] - particles.position(1, i) * particles.velocity[0][i]) /
                 particles.inverse_mass[i] +
             particles.velocity[2][i] / particles.inverse_inertia[i];
    return sum;
  };
  stepper->start();
  const Real before = angular();
  bool met = false;
  while (stepper->time() < 0.5) {
    stepper->advance();
    met = met || scene.forces->contacts().touching() > 0;
  }
  EXPECT_TRUE(met);
  EXPECT_NEAR((particles.velocity[0][0] + particles.velocity[0][1]) / 2, 1, 1e-12);
  EXPECT_NEAR(angular(), before, 1e-9 * std::abs(before));
}

TEST(contacts, equal_squares_stand_on_one_another) {
  Scene scene;
  scene.contact = {1e8, 1e8, 1, 0.5, 1};
  for (Index i = 0; i < 5; ++i) scene.add(OutlineKind::rectangle, {0, 0.5 + i}, 0.5, 0.5, 0, i);
  scene.add_wall({-10, 0}, {10, 0});
  scene.supports.gravity = {0, -9.81};
  auto stepper = scene.make(2e-5);
  stepper->start();
  while (stepper->time() < 2) stepper->advance();
  // The springs of a face: 2 k_n l on the wall, k_n l between elements.
  const Real weight = scene.density * 9.81;
  EXPECT_NEAR(stepper->particles().displacement[1][4], -weight * (5 / 2e8 + (4 + 3 + 2 + 1) / 1e8), 1e-3 * weight * 12.5e-8);
  EXPECT_NEAR(stepper->particles().displacement[0][4], 0, 1e-9);
  EXPECT_NEAR(scene.forces->support_force(0)[1], -5 * weight, 1e-3 * weight);
}

TEST(contacts, a_support_that_moves_does_its_work) {
  Scene scene;
  scene.contact = {1e8, 1e8, 0.5, 0.5, 1};
  scene.add(OutlineKind::rectangle, {0, 0.5}, 0.5, 0.5);
  scene.add_wall({-10, 0}, {10, 0});
  scene.supports.gravity = {0, -9.81};
  laws::GroundMotion lift;
  lift.shape = laws::GroundMotion::Shape::record;
  lift.quantity = laws::MotionQuantity::velocity;
  lift.record = laws::Record::make(10, {0.1, 0.1});
  scene.supports.motions = {lift};
  scene.supports.driven = {{1, 1, 0, 1}};
  auto stepper = scene.make(2e-5);
  stepper->start();
  while (stepper->time() < 1) stepper->advance();
  EXPECT_NEAR(stepper->particles().displacement[1][0], 0.1, 1e-3);
  // It lifts the block, gives it its velocity at once, and as much again goes to the dashpots.
  const Real mass = scene.density, expected = mass * 9.81 * 0.1 + mass * 0.1 * 0.1;
  EXPECT_NEAR(scene.forces->energy_parts(stepper->particles()).supports, expected, 1e-4 * expected);
}

TEST(contacts, base_friction_drags_as_21_says) {
  // A free element on a plate that moves: it reaches the plate's velocity with mu g.
  Scene scene;
  scene.contact = {1e8, 1e8, 0.5, 0.5, 1};
  scene.base_friction = {0.4, {0, -0.5}, 9.81};
  scene.add(OutlineKind::rectangle, {0, 0.5}, 0.5, 0.5);
  auto stepper = scene.make(1e-4);
  stepper->start();
  while (stepper->time() < 0.05) stepper->advance();
  EXPECT_NEAR(stepper->velocity()[1][0], -0.4 * 9.81 * stepper->time(), 1e-3);
  while (stepper->time() < 0.5) stepper->advance();
  EXPECT_NEAR(stepper->velocity()[1][0], -0.5, 1e-9);
}

}  // namespace
}  // namespace sazare::methods::rectangles
