/// Bonded spheres: statics against beam theory, vibration, breaking, what must be kept, and the same bits.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "sazare/methods/spheres/bonds.hpp"
#include "sazare/parallel/threads.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

constexpr Real radius = 0.01, spacing = 0.02, bond_radius = 0.008, modulus = 1e7, poisson = 0.3;
constexpr Real infinite = std::numeric_limits<Real>::infinity();

struct BondRules {
  laws::BondStrength<Real> strength{infinite, infinite, 0, 1};
  Real damping = 0;  ///< share of the critical one
  Real step = 1e-5;
  Vector3 gravity = Vector3::Zero();
  Real friction = 0, restitution = 1;
  int finest = 0;  ///< levels 0 to this one are dealt to the spheres in turn
};

Bond bond_of(const state::Spheres& spheres, Index first, Index second, Real damping) {
  Bond bond;
  bond.first = first;
  bond.second = second;
  bond.radius = bond_radius;
  const auto &one = spheres.place[static_cast<std::size_t>(first)], &other = spheres.place[static_cast<std::size_t>(second)];
  const Vector3 apart = other.centre() - one.centre();
  bond.stiffness = laws::beam_stiffness(apart.norm(), bond_radius, modulus, poisson);
  bond.direction = apart.normalized();
  const Real mass = 0.5 * one.mass, inertia = 0.2 * one.mass * radius * radius;
  bond.damping = {2 * damping * std::sqrt(bond.stiffness.stretch * mass),
                  2 * damping * std::sqrt(bond.stiffness.shear * mass) / bond.stiffness.length,
                  2 * damping * std::sqrt(bond.stiffness.bend * inertia)};
  return bond;
}

/// Spheres that are bonded to their neighbours on a cubic lattice; those before `held` do not move.
methods::spheres::SphereStepper lattice(int nx, int ny, int nz, std::size_t held, const BondRules& rules,
                              const Vector3& spin = Vector3::Zero(), const Vector3& pull = Vector3::Zero()) {
  state::Spheres spheres;
  const auto number = [&](int i, int j, int k) { return static_cast<Index>((i * ny + j) * nz + k); };
  std::vector<Bond> bonds;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) {
        const Vector3 centre = spacing * Vector3(i, j, k);
        spheres.add(centre, radius, 2500, 0, spheres.size() < held);
        if (spheres.size() > held)
          spheres.set_motion(spheres.size() - 1, spin.cross(centre) + (2 * i >= nx ? pull : Vector3(Vector3::Zero())), spin);
      }
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) {
        if (i + 1 < nx) bonds.push_back(bond_of(spheres, number(i, j, k), number(i + 1, j, k), rules.damping));
        if (j + 1 < ny) bonds.push_back(bond_of(spheres, number(i, j, k), number(i, j + 1, k), rules.damping));
        if (k + 1 < nz) bonds.push_back(bond_of(spheres, number(i, j, k), number(i, j, k + 1), rules.damping));
      }
  std::vector<std::int8_t> level;
  for (std::size_t n = 0; n < spheres.size(); ++n)
    level.push_back(static_cast<std::int8_t>(static_cast<int>(n % 7) % (rules.finest + 1)));
  return {std::move(spheres),
          table({.restitution = rules.restitution, .friction = rules.friction}),
          {},
          {rules.step, rules.gravity, 1e-3, 5e-3, level},
          Bonds(std::move(bonds), {rules.strength})};
}

/// A cantilever that sags under its own weight: Timoshenko's beam under loads at its nodes.
TEST(bonds, a_cantilever_sags_as_beam_theory_says) {
  const int count = 5;
  auto stepper = lattice(count, 1, 1, 1, {.damping = 1, .step = 5e-5, .gravity = {0, 0, -0.1}});
  stepper.start();
  advance(stepper, 60000);
  const Real mass = stepper.spheres().place[0].mass, area = std::numbers::pi * bond_radius * bond_radius,
             second_moment = 0.25 * area * bond_radius * bond_radius, coefficient = 6 * (1 + poisson) / (7 + 6 * poisson);
  Real sag = 0;
  const Real end = spacing * (count - 1);
  for (int n = 1; n < count; ++n) {
    const Real at = n * spacing;  // load mass g at `at` moves the end by this much
    sag += mass * 0.1 *
           (at * at * (3 * end - at) / (6 * modulus * second_moment) + at / (coefficient * modulus / (2 * (1 + poisson)) * area));
  }
  EXPECT_GT(sag, 1e-5);
  EXPECT_NEAR(centre_of(stepper, count - 1).z(), -sag, 2e-4 * sag);
}

TEST(bonds, a_spinning_bar_keeps_momentum_angular_momentum_and_energy) {
  auto stepper = lattice(3, 2, 6, 0, {.step = 1e-5}, {20, -10, 30}, {0.05, 0.1, -0.03});
  stepper.start();
  const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
  const Real energy = stepper.energies().sum();
  advance(stepper, 4000);  // more than a turn
  EXPECT_GT(stepper.energies().bonds, 2e-4 * energy);
  EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-12 * turning.norm());
  EXPECT_NEAR(stepper.energies().sum(), energy, 2e-4 * energy);
}

TEST(bonds, of_several_levels_keep_momentum_angular_momentum_and_energy) {
  auto stepper = lattice(3, 2, 6, 0, {.step = 2e-5, .finest = 2}, {20, -10, 30}, {0.05, 0.1, -0.03});
  stepper.start();
  EXPECT_EQ(stepper.levels().finest(), 2);
  const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
  const Real energy = stepper.energies().sum();
  advance(stepper, 2000);
  EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-12 * turning.norm());
  EXPECT_NEAR(stepper.energies().sum(), energy, 1e-3 * energy);
}

/// Where a bar that is pulled apart and turns stands, against small steps.
Real error_of_a_bar(Real step, int finest) {
  constexpr Real end = 4e-3;
  const auto walk = [&](Real h, int levels) {
    auto stepper = lattice(6, 1, 1, 0, {.damping = 0.02, .step = h, .finest = levels}, {0, 20, 30}, {0.05, 0.1, -0.03});
    stepper.start();
    advance(stepper, static_cast<int>(std::lround(end / h)));
    return stepper;
  };
  const auto exact = walk(end / 16000, 0), coarse = walk(step, finest);
  Real squares = 0;
  for (Index n = 0; n < 6; ++n) squares += (velocity_of(exact, n) - velocity_of(coarse, n)).squaredNorm();
  return std::sqrt(squares);
}

TEST(bonds, of_several_levels_are_of_second_order) {
  const Real coarse = error_of_a_bar(4e-3 / 200, 2), fine = error_of_a_bar(4e-3 / 800, 2);
  EXPECT_NEAR(std::log2(coarse / fine) / 2, 2, 0.15);
}

TEST(bonds, a_rigid_turn_leaves_them_at_rest) {
  // Slow enough for the centrifugal stretch to be small; the bar turns by 6 rad.
  auto stepper = lattice(2, 1, 1, 0, {.step = 1e-4}, {0, 0, 0.2});
  stepper.start();
  advance(stepper, 300000);
  EXPECT_NEAR((centre_of(stepper, 1) - centre_of(stepper, 0)).norm(), spacing, 1e-6 * spacing);
  EXPECT_NEAR(spin_of(stepper, 0).z(), 0.2, 1e-5);
}

/// First bending frequency of a free bar would need many nodes; two spheres on a spring have it exactly.
TEST(bonds, two_spheres_swing_at_the_frequency_of_their_spring) {
  auto stepper = lattice(2, 1, 1, 0, {.step = 1e-6}, Vector3::Zero(), {1e-4, 0, 0});
  const Real mass = stepper.spheres().place[0].mass, stiffness = modulus * std::numbers::pi * bond_radius * bond_radius / spacing;
  const Real quarter = 0.25 * 2 * std::numbers::pi / std::sqrt(2 * stiffness / mass);
  stepper.start();
  advance(stepper, static_cast<int>(quarter / 1e-6));
  const Real stretch = (centre_of(stepper, 1) - centre_of(stepper, 0)).norm() - spacing;
  EXPECT_NEAR(stretch, 1e-4 / std::sqrt(2 * stiffness / mass), 1e-4 * stretch);
}

TEST(bonds, the_stable_step_is_where_the_motion_begins_to_grow) {
  const auto grows = [](Real share, Real damping) {
    BondRules rules{.damping = damping};
    auto probe = lattice(2, 1, 1, 0, rules);
    rules.step = share * stable_step(probe.bonds().bonds(), probe.spheres());
    auto stepper = lattice(2, 1, 1, 0, rules, Vector3::Zero(), {1e-6, 1e-6, 0});
    stepper.start();
    const Real energy = stepper.energies().sum();
    advance(stepper, 100);
    const methods::spheres::SphereEnergies now = stepper.energies();
    return !(now.translation + now.rotation + now.bonds < 10 * energy);
  };
  EXPECT_FALSE(grows(0.99, 0));
  EXPECT_TRUE(grows(1.02, 0));
  EXPECT_FALSE(grows(0.99, 0.4));
  EXPECT_TRUE(grows(1.5, 0.4));
}

/// Two spheres pulled apart: what the bond took is its fracture energy, and then they fly freely.
TEST(bonds, a_softening_bond_takes_its_fracture_energy) {
  const Real strength = 1e4, fracture_energy = 20, area = std::numbers::pi * bond_radius * bond_radius;
  const Real ultimate = laws::ultimate_use(strength, modulus / spacing, fracture_energy);
  auto stepper = lattice(2, 1, 1, 0, {.strength = {strength, infinite, 0, ultimate}, .step = 1e-6}, Vector3::Zero(), {3, 0, 0});
  stepper.start();
  const Real before = stepper.energies().sum();
  advance(stepper, 10000);
  EXPECT_EQ(stepper.broken_bonds(), 1);
  EXPECT_EQ(stepper.energies().bonds, 0);
  EXPECT_NEAR(stepper.energies().fracture, fracture_energy * area, 1e-3 * fracture_energy * area);
  EXPECT_NEAR(stepper.energies().sum(), before, 1e-5 * before);
}

TEST(bonds, a_brittle_bond_breaks_at_its_strength) {
  for (const auto& [pull, broken] : {std::pair(0.95, 0), std::pair(1.05, 1)}) {
    const Real strength = 1e4;
    auto stepper = lattice(2, 1, 1, 0, {.strength = {strength, infinite, 0, 1}, .step = 1e-6});
    const Real mass = stepper.spheres().place[0].mass, area = std::numbers::pi * bond_radius * bond_radius;
    // Energy of the relative motion that stretches the bond to `pull` times its strength.
    const Real speed = pull * strength * std::sqrt(2 * area * spacing / (modulus * mass));
    stepper = lattice(2, 1, 1, 0, {.strength = {strength, infinite, 0, 1}, .step = 1e-6}, Vector3::Zero(), {speed, 0, 0});
    stepper.start();
    const Real before = stepper.energies().sum();
    advance(stepper, 5000);
    EXPECT_EQ(stepper.broken_bonds(), broken) << pull;
    EXPECT_NEAR(stepper.energies().sum(), before, 1e-4 * before);
  }
}

/// Bonded spheres have no contact; when the bond has broken they do.
TEST(bonds, a_broken_bond_leaves_the_contact) {
  for (const bool breaks : {false, true}) {
    auto stepper = lattice(2, 1, 1, 0, {.strength = {infinite, breaks ? 1e4 : infinite, 0, 1}, .step = 1e-6}, Vector3::Zero(),
                           {-0.2, 1.5, 0});
    stepper.start();
    const Real before = stepper.energies().sum();
    std::int64_t touched = 0;
    for (int k = 0; k < 20000; ++k) {
      stepper.advance();
      touched += stepper.contacts();
    }
    stepper.evaluate_now();
    EXPECT_EQ(stepper.broken_bonds(), breaks ? 1 : 0);
    EXPECT_EQ(touched > 0, breaks);
    EXPECT_NEAR(stepper.energies().sum(), before, 2e-3 * before);
  }
}

TEST(bonds, dashpots_take_what_the_energy_balance_says) {
  auto stepper = lattice(2, 2, 5, 0, {.damping = 0.1, .step = 2e-6}, {20, -10, 30}, {0.05, 0.1, -0.03});
  stepper.start();
  const Real before = stepper.energies().sum();
  const Vector3 turning = stepper.angular_momentum();
  advance(stepper, 20000);
  EXPECT_GT(stepper.energies().bond_drag, 1e-3 * before);
  EXPECT_NEAR(stepper.energies().sum(), before, 2e-2 * stepper.energies().bond_drag);
  EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-12 * turning.norm());
}

test::MemoryArchive state_of(methods::spheres::SphereStepper& stepper) {
  test::MemoryArchive archive;
  stepper.columns(archive);
  return archive;
}

/// A bar of three tiles that whirls, breaks and is sorted anew.
methods::spheres::SphereStepper whirl() {
  return lattice(14, 14, 14, 0,
                 {.strength = {2e4, 2e4, 0.3, 1.5},
                  .damping = 0.05,
                  .step = 2e-5,
                  .gravity = {0, 0, -10},
                  .friction = 0.4,
                  .restitution = 0.6},
                 {30, -20, 50}, {0.5, 1, -0.3});
}

TEST(bonds, give_the_same_bits_on_any_number_of_threads) {
  const auto run = [](int threads) {
    parallel::set_threads(threads);
    auto stepper = whirl();
    stepper.start();
    advance(stepper, 150);
    EXPECT_GE(stepper.searches(), 2);
    EXPECT_GT(stepper.broken_bonds(), 20);
    EXPECT_LT(stepper.broken_bonds(), 7000);
    parallel::set_threads(1);
    return state_of(stepper);
  };
  const auto alone = run(1);
  for (const int threads : {2, 3}) EXPECT_TRUE(run(threads) == alone) << threads;
}

TEST(bonds, go_on_from_a_checkpoint_as_if_nothing_had_been) {
  auto through = whirl(), resumed = whirl();
  through.start();
  advance(through, 250);
  EXPECT_GT(through.broken_bonds(), 20);
  test::MemoryArchive checkpoint = state_of(through);
  checkpoint.turn_round();
  resumed.columns(checkpoint);
  advance(through, 150);
  advance(resumed, 150);
  EXPECT_TRUE(state_of(through) == state_of(resumed));
}

}  // namespace
}  // namespace sazare::methods::spheres
