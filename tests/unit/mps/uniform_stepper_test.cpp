#include <gtest/gtest.h>

#include "sazare/particles/uniform_stepper.hpp"
#include "tests/support/memory_archive.hpp"
#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {
namespace {

using particles::Integrator;

/// A free rectangle that vibrates and turns.
particles::UniformStepper<2> free_body(Real step, Integrator integrator, Real ratio = 0) {
  const auto sites = box_sites<2>({4, 10});
  state::Particles<2> particles = make_particles<2>(sites, 1.0, {1500, 100, 200, ratio});
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Real y = particles.start[1][i] / 10;
    particles.velocity[0][i] = 20 * y * y - 3 * y;
    particles.velocity[1][i] = 5 * y;
  }
  return {particles, std::make_unique<ElasticForces<2>>(make_links<2>(sites, 1.0, 1.5), RotationRemoval::mean_rotation),
          particles::ParticleSupports<2>{}, particles::UniformRules{step, integrator, laws::RayleighDamping::make(1, 15)}};
}

Real total_energy(particles::UniformStepper<2>& stepper) { return stepper.kinetic_energy() + stepper.elastic_energy(); }

TEST(uniform_stepper, keeps_energy_of_a_free_body_at_large_rotation) {
  for (const Real step : {1e-3, 5e-4}) {
    auto stepper = free_body(step, Integrator::verlet);
    stepper.start();
    const Real before = total_energy(stepper);
    Real worst = 0;
    for (int i = 0; i < static_cast<int>(4 / step); ++i) {
      stepper.advance();
      if (i % 50 == 0) worst = std::max(worst, std::abs(total_energy(stepper) / before - 1));
    }
    EXPECT_LT(worst, 2e-2 * (step / 1e-3) * (step / 1e-3));
    EXPECT_GT(std::abs(stepper.particles().angle[0]), 1.0);  // it has turned by then
  }
}

TEST(uniform_stepper, verlet_and_leapfrog_are_the_same_but_for_round_off) {
  auto verlet = free_body(1e-3, Integrator::verlet, 0.05), leapfrog = free_body(1e-3, Integrator::leapfrog, 0.05);
  verlet.start();
  leapfrog.start();
  for (int i = 0; i < 500; ++i) {
    verlet.advance();
    leapfrog.advance();
  }
  for (std::size_t i = 0; i < verlet.particles().size(); ++i)
    EXPECT_NEAR(verlet.particles().displacement[0][i], leapfrog.particles().displacement[0][i], 1e-9);
}

/// Error against a fine solution at a fixed time.
Real error_at(Real step, Integrator integrator, const particles::UniformStepper<2>& fine) {
  auto stepper = free_body(step, integrator, 0.05);
  stepper.start();
  while (stepper.time() < 0.1 - 1e-9) stepper.advance();
  return std::abs(stepper.particles().displacement[0][3] - fine.particles().displacement[0][3]);
}

TEST(uniform_stepper, orders_of_the_integrators) {
  auto fine = free_body(1e-5, Integrator::verlet, 0.05);
  fine.start();
  while (fine.time() < 0.1 - 1e-9) fine.advance();
  // The lagged damping force makes the damped leapfrog of first order too.
  for (const Integrator integrator : {Integrator::euler, Integrator::verlet}) {
    const Real coarse = error_at(4e-4, integrator, fine), half = error_at(2e-4, integrator, fine);
    EXPECT_NEAR(coarse / half, 2, 0.25) << static_cast<int>(integrator);
  }
  auto undamped = [&](Real step) {
    auto stepper = free_body(step, Integrator::verlet);
    stepper.start();
    while (stepper.time() < 0.1 - 1e-9) stepper.advance();
    return stepper.particles().displacement[0][3];
  };
  const Real exact = undamped(1e-5);
  EXPECT_NEAR((undamped(2e-4) - exact) / (undamped(1e-4) - exact), 4, 0.3);
}

TEST(uniform_stepper, goes_on_bit_for_bit_after_a_checkpoint) {
  auto whole = free_body(1e-3, Integrator::verlet, 0.05), first = free_body(1e-3, Integrator::verlet, 0.05);
  auto second = free_body(1e-3, Integrator::verlet, 0.05);
  whole.start();
  first.start();
  for (int i = 0; i < 40; ++i) whole.advance();
  for (int i = 0; i < 17; ++i) first.advance();
  test::MemoryArchive saved;
  first.columns(saved);
  saved.turn_round();
  second.columns(saved);
  for (int i = 17; i < 40; ++i) second.advance();
  EXPECT_EQ(whole.particles().displacement, second.particles().displacement);
  EXPECT_EQ(whole.particles().velocity, second.particles().velocity);
  EXPECT_EQ(whole.particles().rotation, second.particles().rotation);
}

/// A layer without end on a viscous base: under gravity the surface sinks by rho g H^2/(2 M), the base carries the weight, and
/// nothing moves afterwards.
TEST(uniform_stepper, settles_on_a_viscous_base_and_stays_at_rest) {
  constexpr int high = 40;
  constexpr Real spacing = 0.5, gravity = 9.81;
  const Soil soil{.damping_ratio = 0.02};
  const auto sites = box_sites<2>({3, high});
  auto particles = make_particles<2>(sites, spacing, soil);
  auto links = make_links<2>(sites, spacing, 1.5, {3, 0});
  particles::ParticleSupports<2> supports;
  supports.gravity = {0, -gravity};
  std::vector<Index> base;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (sites[i][1] != 0) continue;
    base.push_back(static_cast<Index>(i));
    particles.inverse_mass[i] *= 2;
    particles.inverse_inertia[i] *= 2;
    particles.lame[i] *= 2;
    for (const int axis : {0, 1})
      supports.dashpots.push_back({base.back(), axis, 2 * (axis == 1 ? soil.p_wave_velocity : soil.s_wave_velocity) / spacing});
  }
  links.halve_among(base);
  particles::UniformStepper<2> stepper(particles, std::make_unique<ElasticForces<2>>(links, RotationRemoval::mean_rotation),
                                    supports, {1e-3, particles::Integrator::verlet, laws::RayleighDamping::make(1, 10)});
  EXPECT_LT(stepper.relax({1e-6, 20000}), 1e-6);
  const Real length = (high - 1) * spacing, modulus = soil.density * soil.p_wave_velocity * soil.p_wave_velocity;
  const Real expected = -soil.density * gravity * (0.5 * length * length + 0.5 * spacing * length) / modulus;
  EXPECT_NEAR(stepper.initial_displacement()[1][high - 1], expected, 1e-3 * std::abs(expected));
  for (const particles::Dashpot& dashpot : stepper.supports().dashpots) {
    const Real weight = dashpot.freedom == 1 ? gravity * (2 * high - 1) : 0;
    EXPECT_NEAR(dashpot.reaction, weight, 1e-6 * gravity * high);
  }
  stepper.start();
  for (int step = 0; step < 2000; ++step) stepper.advance();
  EXPECT_LT(std::abs(stepper.particles().displacement[1][high - 1] - stepper.initial_displacement()[1][high - 1]), 1e-6);
  EXPECT_LT(std::abs(stepper.velocity()[1][high - 1]), 1e-5);
}

}  // namespace
}  // namespace sazare::methods::mps
