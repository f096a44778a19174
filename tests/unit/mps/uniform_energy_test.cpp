#include <gtest/gtest.h>

#include <algorithm>

#include "sazare/particles/uniform_stepper.hpp"
#include "tests/support/memory_archive.hpp"
#include "tests/unit/mps/column.hpp"

namespace sazare::methods::mps {
namespace {

using particles::Integrator;
using particles::WorkByCause;

constexpr Real step = 4e-4;  // [s]; five times as much is stable without damping, not with a ratio of 0.05
constexpr Real spacing = 0.5;

/// What the energy balance of a run says at present.
struct Balance {
  explicit Balance(particles::UniformStepper<2>& stepper)
      : carried(stepper.kinetic_energy_of_kick() + stepper.elastic_energy()), work(stepper.work()) {}

  Real carried;
  WorkByCause work;
};

/// Energy that no cause accounts for, over the largest that was there, in a run.
Real largest_residual(particles::UniformStepper<2>& stepper, int steps) {
  stepper.start();
  const Real beginning = Balance(stepper).carried;
  EXPECT_NEAR(Balance(stepper).work.sum(), 0, 1e-15 * std::abs(beginning));
  Real worst = 0, most = beginning;
  for (int i = 0; i < steps; ++i) {
    stepper.advance();
    const Balance now(stepper);
    most = std::max(most, now.carried);
    worst = std::max(worst, std::abs(beginning + now.work.sum() - now.carried));
  }
  return worst / most;
}

/// A column with its base and sides held, that begins with a velocity.
Column2 moving_column(Real ratio) {
  Column2 column(4, 40, spacing, {.damping_ratio = ratio});
  Noise noise;
  for (std::size_t i = 0; i < column.particles.size(); ++i)
    for (const std::size_t freedom : {0, 1, 2}) column.particles.velocity[freedom][i] = 1e-6 * noise();
  return column;
}

TEST(uniform_energy, close_to_round_off_for_small_motion_at_any_step) {
  for (const Integrator integrator : {Integrator::verlet, Integrator::leapfrog})
    for (const Real ratio : {0.0, 0.05}) {
      Column2 column = moving_column(ratio);
      column.supports.gravity = {0, -1e-6};
      auto stepper = column.stepper({ratio > 0 ? step : 5 * step, integrator, laws::RayleighDamping::make(1, 15)});
      EXPECT_LT(largest_residual(stepper, 500), 1e-7) << ratio;
      const Real damping = stepper.work().damping;
      EXPECT_TRUE(ratio > 0 ? damping < 0 : damping == 0) << damping;
    }
}

TEST(uniform_energy, close_with_the_square_of_the_step_for_large_rotations) {
  const auto residual = [](Real dt) {
    const auto sites = box_sites<2>({4, 10});
    state::Particles<2> particles = make_particles<2>(sites, 1.0, {1500, 100, 200, 0.02});
    for (std::size_t i = 0; i < particles.size(); ++i) particles.velocity[0][i] = 2 * particles.start[1][i];
    particles::UniformStepper<2> stepper(
        particles, std::make_unique<ElasticForces<2>>(make_links<2>(sites, 1.0, 1.5), RotationRemoval::mean_rotation), {},
        {dt, Integrator::verlet, laws::RayleighDamping::make(1, 15)});
    return largest_residual(stepper, static_cast<int>(0.5 / dt));
  };
  const Real coarse = residual(1e-3), fine = residual(5e-4);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_GT(coarse / fine, 3);
}

/// Particles of a base, of half a spacing, with dashpots of the ground below.
void stand_on_viscous_base(Column2& column, const Soil& soil, const laws::GroundMotion& wave) {
  column.supports = {};
  column.supports.motions.push_back(wave);
  std::vector<Index> base;
  for (std::size_t i = 0; i < column.sites.size(); ++i) {
    column.supports.held.push_back({static_cast<Index>(i), 1});
    column.supports.held.push_back({static_cast<Index>(i), 2});
    if (column.sites[i][1] != 0) continue;
    base.push_back(static_cast<Index>(i));
    column.particles.inverse_mass[i] *= 2;
    column.supports.dashpots.push_back({base.back(), 0, 2 * soil.s_wave_velocity / spacing, 0});
  }
  column.links.halve_among(base);
}

TEST(uniform_energy, count_the_energy_that_a_wave_brings_in_and_takes_out) {
  const Soil soil;
  const int across = 3, high = 100;
  laws::GroundMotion wave;
  wave.quantity = laws::MotionQuantity::velocity;
  wave.amplitude = 1e-6;
  wave.ricker_wave = {4, 0.3};
  Column2 column(across, high, spacing, soil);
  stand_on_viscous_base(column, soil, wave);
  auto stepper = column.stepper({step, Integrator::verlet, {}});
  stepper.start();
  Real flux = 0, most = 0, worst = 0;
  for (int i = 0; i < 5000; ++i) {
    stepper.advance();
    const Real velocity = wave.at(stepper.time()).velocity;
    flux += step * soil.density * soil.s_wave_velocity * velocity * velocity * across * spacing;
    most = std::max(most, stepper.work().boundary);
    worst = std::max(worst, std::abs(stepper.work().boundary - Balance(stepper).carried));
  }
  EXPECT_LT(worst, 1e-7 * most);
  EXPECT_NEAR(most, flux, 0.03 * flux);
  EXPECT_LT(stepper.work().boundary, 0.01 * most);  // the wave has left
}

TEST(uniform_energy, count_what_a_moving_support_gives) {
  Column2 column(4, 40, spacing, {.damping_ratio = 0.05});
  laws::GroundMotion shake;
  shake.shape = laws::GroundMotion::Shape::sine;
  shake.amplitude = 1e-5;
  shake.sine_wave = {2, 0};
  column.supports = {};
  column.supports.motions.push_back(shake);
  for (std::size_t i = 0; i < column.sites.size(); ++i)
    if (column.sites[i][1] == 0) column.supports.driven.push_back({static_cast<Index>(i), 0, 0, 1});
  auto stepper = column.stepper({step, Integrator::leapfrog, laws::RayleighDamping::make(1, 15)});
  EXPECT_LT(largest_residual(stepper, 2000), 1e-7);
  EXPECT_GT(stepper.work().prescribed, 0);
}

/// A column in shear whose base has moved steadily for a while: how far its top is behind, and what its energy balance leaves.
struct Carried {
  Real behind = 0, residual = 0;
  WorkByCause work;
};

constexpr int carried_height = 20;  // particles, the lowest one at the base
constexpr Real carried_speed = 1e-4, carried_ratio = 0.2;

/// `pull` is an acceleration back, of all particles [m/s2].
Carried carry_column(bool relative, Real speed, Real pull = 0, Integrator integrator = Integrator::leapfrog) {
  Column2 column(3, carried_height, spacing, {.damping_ratio = carried_ratio});
  laws::GroundMotion steady;
  steady.shape = laws::GroundMotion::Shape::record;
  steady.quantity = laws::MotionQuantity::velocity;
  steady.amplitude = speed;
  steady.record = laws::Record::make(100, {1, 1});
  column.supports = {};
  column.supports.motions.push_back(steady);
  column.supports.gravity.x() = -pull;
  for (std::size_t i = 0; i < column.sites.size(); ++i) {
    column.supports.held.push_back({static_cast<Index>(i), 1});
    if (column.sites[i][1] == 0) column.supports.driven.push_back({static_cast<Index>(i), 0, 0, 1});
  }
  if (relative) column.supports.find_base();
  auto stepper = column.stepper({step, integrator, laws::RayleighDamping::make(1, 15)});
  Carried result;
  result.residual = largest_residual(stepper, 30000);
  const auto& moved = stepper.particles().displacement[0];
  const auto of_row = [&](int row) {
    for (std::size_t i = 0; i < column.sites.size(); ++i)
      if (column.sites[i][1] == row) return moved[i];
    return Real{0};
  };
  result.behind = of_row(0) - of_row(carried_height - 1);
  result.work = stepper.work();
  return result;
}

TEST(damping, leaves_a_column_alone_that_moves_with_its_base) {
  for (const Integrator integrator : {Integrator::leapfrog, Integrator::verlet}) {
    const Carried with_base = carry_column(true, carried_speed, 0, integrator);
    EXPECT_NEAR(with_base.behind, 0, 1e-8 * carried_speed);
    EXPECT_LT(with_base.residual, 1e-7);
    EXPECT_LT(with_base.work.damping, 0);     // of the swing with which the base set out
    EXPECT_GT(with_base.work.prescribed, 0);  // that, and the motion of the column
  }
}

/// In space every particle is held back by a1 h m v, as by a force of that size on a column that stands still.
TEST(damping, in_space_holds_a_column_back) {
  const Carried in_space = carry_column(false, carried_speed);
  const Real pull = laws::RayleighDamping::make(1, 15).mass_rate * carried_ratio * carried_speed;
  const Real behind = carry_column(false, 0, pull).behind;
  EXPECT_GT(behind, 1e-3 * carried_speed);
  EXPECT_NEAR(in_space.behind, behind, 1e-4 * behind);
  EXPECT_LT(in_space.residual, 1e-7);
}

TEST(uniform_energy, count_what_forces_from_outside_do) {
  for (const Real ratio : {0.0, 0.05}) {
    Column2 column = moving_column(ratio);
    auto stepper = column.stepper({step, Integrator::leapfrog, laws::RayleighDamping::make(1, 15)});
    std::vector<Vector3> push(column.particles.size(), Vector3::Zero());
    const auto apply = [&] {
      for (std::size_t i = 0; i < push.size(); ++i) push[i] = {std::sin(20 * stepper.time() + static_cast<Real>(i)), 0.3, 0};
      stepper.apply(push);
    };
    apply();
    stepper.start();
    const Real beginning = Balance(stepper).carried;
    Real worst = 0, most = 0;
    for (int i = 0; i < 1000; ++i) {
      apply();
      stepper.advance();
      const Balance now(stepper);
      most = std::max(most, now.carried);
      worst = std::max(worst, std::abs(beginning + now.work.sum() - now.carried));
    }
    EXPECT_LT(worst, 1e-7 * most) << ratio;
    EXPECT_GT(stepper.work().applied, 100 * beginning);
    EXPECT_EQ(stepper.work().applied, stepper.applied_work());
  }
}

TEST(uniform_energy, nothing_moves_where_a_force_carries_the_weight) {
  Column2 column(4, 10, spacing, {});
  column.supports.gravity = {0, -2};
  auto stepper = column.stepper({step, Integrator::verlet, {}});
  std::vector<Vector3> lift;
  for (std::size_t i = 0; i < column.particles.size(); ++i) lift.emplace_back(0, 2 / column.particles.inverse_mass[i], 0);
  stepper.apply(lift);
  stepper.start();
  for (int i = 0; i < 100; ++i) stepper.advance();
  for (std::size_t i = 0; i < column.particles.size(); ++i) EXPECT_NEAR(stepper.particles().displacement[1][i], 0, 1e-15);
  stepper.apply(std::vector<Vector3>(lift.size(), Vector3::Zero()));
  for (int i = 0; i < 100; ++i) stepper.advance();
  EXPECT_LT(std::ranges::min(stepper.particles().displacement[1]), -1e-5);  // let go, it sags between the sides that are held
}

TEST(uniform_energy, go_on_bit_for_bit_after_a_checkpoint) {
  const Column2 column = moving_column(0.05);
  const auto make = [&] { return column.stepper({step, Integrator::verlet, laws::RayleighDamping::make(1, 15)}); };
  auto whole = make(), second = make();
  whole.start();
  for (int i = 0; i < 20; ++i) whole.advance();
  test::MemoryArchive saved;
  whole.columns(saved);
  saved.turn_round();
  second.columns(saved);
  for (int i = 0; i < 20; ++i) {
    whole.advance();
    second.advance();
  }
  EXPECT_EQ(whole.work().damping, second.work().damping);
}

}  // namespace
}  // namespace sazare::methods::mps
