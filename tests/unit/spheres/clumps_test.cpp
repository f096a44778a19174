/// Rigid clumps: free flight, impacts, what must be kept, and the same bits.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/parallel/threads.hpp"
#include "sazare/state/clumps.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

/// Bodies of three spheres in a row and one beside them; no two of their inertias are alike.
class Heap {
public:
  state::Spheres spheres;
  state::Clumps clumps;

  void add(const Vector3& centre, const Vector3& velocity, const Vector3& angular_momentum, Real size = 1) {
    const std::array<Vector3, 4> arms{Vector3(-0.012, -0.002, 0), Vector3(0, -0.002, 0), Vector3(0.012, -0.002, 0),
                                      Vector3(0, 0.01, 0)};
    state::Clump clump;
    clump.centre = centre;
    clump.velocity = velocity;
    clump.angular_momentum = angular_momentum;
    clump.mass = 0.03 * std::pow(size, 3);
    clump.inertia = std::pow(size, 5) * Vector3{1.5e-6, 3e-6, 4e-6};
    clump.first_member = static_cast<std::int64_t>(clumps.members.size());
    clumps.clumps.push_back(clump);
    for (const Vector3& arm : arms) {
      clumps.members.push_back({static_cast<Index>(spheres.size()), 0, size * arm});
      spheres.add(centre + size * arm, 0.007 * size, 2500, 0, true);
      spheres.place.back().mass = clump.mass;
    }
  }

  methods::spheres::SphereStepper stepper(const Rules& rules, std::vector<Wall> walls = {}) const {
    return {spheres, table(rules), std::move(walls), {rules.step, rules.gravity, rules.margin, 5e-3, rules.level}, {}, clumps};
  }
};

/// With `small`, every third body has half the size.
Heap cloud(int across, Real speed = 0.5, bool small = false) {
  std::uint64_t state = 5;
  const auto random = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<Real>(state >> 11) / 4503599627370496.0 - 1;
  };
  Heap heap;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < across; ++k) {
        const Real size = small && heap.clumps.clumps.size() % 3 == 0 ? 0.5 : 1, spins = 1e-5 * std::pow(size, 4);
        heap.add(0.045 * Vector3(i, j, k) + Vector3(0.03, 0.03, 0.03), speed * Vector3(random(), random(), random()),
                 {spins * random(), spins * random(), spins * random()}, size);
      }
  return heap;
}

/// Level 2 for the smallest bodies of a cloud.
std::vector<std::int8_t> levels_of(const Heap& heap) {
  std::vector<std::int8_t> level;
  for (const auto& place : heap.spheres.place) level.push_back(place.radius < 0.005 ? 2 : 0);
  return level;
}

TEST(clumps, free_flight_keeps_angular_momentum_to_the_bit_and_energy) {
  Heap heap;
  heap.add({0, 0, 0}, {1, 0, 0}, {1e-5, 2e-4, 2e-5});  // about the middle axis: it tumbles
  auto stepper = heap.stepper({.step = 1e-4});
  stepper.start();
  const Real energy = stepper.energies().rotation;
  Real least = energy, most = energy, backwards = 1;
  for (int k = 0; k < 20000; ++k) {
    stepper.advance();
    stepper.evaluate_now();
    least = std::min(least, stepper.energies().rotation);
    most = std::max(most, stepper.energies().rotation);
    backwards = std::min(backwards, stepper.clumps().clumps[0].out({0, 1, 0}).y());
  }
  EXPECT_EQ(stepper.clumps().clumps[0].angular_momentum.y(), 2e-4);
  EXPECT_LT(backwards, -0.5);  // it does turn over
  EXPECT_LT(most - least, 1e-4 * energy);
  EXPECT_NEAR(stepper.clumps().clumps[0].centre.x(), 2, 1e-12);
}

/// A body that only spins about a principal axis turns by w t.
TEST(clumps, a_steady_spin_is_exact) {
  Heap heap;
  heap.add({0, 0, 0}, {0, 0, 0}, {0, 0, 4e-6});  // 1 rad/s
  auto stepper = heap.stepper({.step = 1e-3});
  stepper.start();
  advance(stepper, 1000);
  const Vector3 now = stepper.clumps().clumps[0].out({1, 0, 0});
  EXPECT_NEAR(now.x(), std::cos(1.0), 1e-12);
  EXPECT_NEAR(now.y(), std::sin(1.0), 1e-12);
  const Vector3 last = centre_of(stepper, 2);
  EXPECT_NEAR(last.x(), 0.012 * std::cos(1.0) + 0.002 * std::sin(1.0), 1e-14);
  EXPECT_NEAR((velocity_of(stepper, 2) - Vector3(0, 0, 1).cross(last)).norm(), 0, 1e-12);
}

TEST(clumps, fall_freely) {
  Heap heap;
  heap.add({0, 0, 1}, {1, 0, 2}, {0, 0, 0});
  auto stepper = heap.stepper({.step = 1e-3, .gravity = {0, 0, -10}});
  stepper.start();
  advance(stepper, 500);
  EXPECT_NEAR(stepper.clumps().clumps[0].centre.z(), 1 + 1 - 1.25, 1e-13);
  EXPECT_NEAR(stepper.energies().sum(), 0.5 * 0.03 * 5 + 0.03 * 10, 1e-14);
}

TEST(clumps, keep_momentum_and_angular_momentum_and_energy_balances) {
  auto stepper = cloud(4).stepper({.restitution = 0.6, .friction = 0.4, .step = 5e-6});
  stepper.start();
  const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
  const Real energy = stepper.energies().sum();
  std::int64_t touched = 0;
  for (int k = 0; k < 6000; ++k) {
    stepper.advance();
    touched += stepper.contacts();
  }
  stepper.evaluate_now();
  EXPECT_GT(touched, 1000);
  EXPECT_GT(stepper.energies().dashpot_work, 0.02 * energy);
  EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-14);
  EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-14);
  EXPECT_NEAR(stepper.energies().sum(), energy, 3e-3 * energy);
}

TEST(clumps, come_to_rest_on_a_floor) {
  Heap heap;
  heap.add({0, 0, 0.05}, {0, 0, 0}, {1e-6, 2e-6, 0});
  auto stepper =
      heap.stepper({.restitution = 0.3, .friction = 0.5, .rolling = 0.05, .step = 2e-5, .gravity = {0, 0, -10}}, {Wall{}});
  stepper.start();
  advance(stepper, 200000);
  EXPECT_LT(stepper.energies().translation + stepper.energies().rotation, 1e-12 * stepper.energies().potential);
  // Flat on its four spheres.
  EXPECT_NEAR(stepper.clumps().clumps[0].centre.z(), 0.007, 1e-4);
  EXPECT_NEAR(stepper.walls().loads().front().force.z(), -0.3, 1e-6);
}

test::MemoryArchive state_of(methods::spheres::SphereStepper& stepper) {
  test::MemoryArchive archive;
  stepper.columns(archive);
  return archive;
}

Rules falling() { return {.restitution = 0.5, .friction = 0.5, .step = 2e-5, .gravity = {0, 0, -10}}; }

/// Bodies of two sizes, the smaller ones at finer levels where `levels`.
methods::spheres::SphereStepper two_sizes(int across, Real speed, Rules rules, bool levels, std::vector<Wall> walls = {}) {
  const Heap heap = cloud(across, speed, true);
  if (levels) rules.level = levels_of(heap);
  return heap.stepper(rules, std::move(walls));
}

TEST(clumps, all_at_one_level_take_the_steps_of_that_level) {
  const Heap heap = cloud(3, 2);
  Rules rules = falling();
  rules.level.assign(heap.spheres.size(), 2);
  auto leveled = heap.stepper(rules, {Wall{}});
  rules.level = {};
  rules.step *= 0.25;
  auto uniform = heap.stepper(rules, {Wall{}});
  leveled.start();
  uniform.start();
  advance(leveled, 500);
  advance(uniform, 2000);
  EXPECT_EQ(leveled.levels().finest(), 2);
  EXPECT_GT(uniform.energies().dashpot_work, 0);  // they have met
  for (std::size_t c = 0; c < heap.clumps.clumps.size(); ++c) {
    const state::Clump &one = leveled.clumps().clumps[c], &other = uniform.clumps().clumps[c];
    EXPECT_LT((one.centre - other.centre).norm(), 1e-11);
    EXPECT_LT((one.angular_momentum - other.angular_momentum).norm(), 1e-14);
  }
}

TEST(clumps, of_one_have_the_finest_level_of_their_spheres) {
  const Heap heap = cloud(2);
  Rules rules = falling();
  rules.level.assign(heap.spheres.size(), 0);
  rules.level[5] = 3;
  auto stepper = heap.stepper(rules);
  stepper.start();
  for (std::size_t number = 0; number < rules.level.size(); ++number)
    EXPECT_EQ(stepper.levels().by_number()[number], number / 4 == 1 ? 3 : 0) << number;
}

TEST(clumps, of_several_levels_keep_momenta_to_the_last_digits) {
  auto stepper = two_sizes(4, 1, {.restitution = 0.6, .friction = 0.4, .step = 2e-5}, true);
  stepper.start();
  stepper.evaluate_now();
  const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
  advance(stepper, 2000);
  EXPECT_EQ(stepper.levels().finest(), 2);
  EXPECT_GT(stepper.energies().sliding_work, 0);
  EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-13 * 42 * 0.03);
  EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-13 * 42 * 0.03 * 0.2);
}

/// Residual of the energy balance after a fall onto a floor, over what was lost.
Real residual_of_a_fall(Real step, bool levels) {
  Rules rules = falling();
  rules.step = step;
  auto stepper = two_sizes(4, 2, rules, levels, {Wall{}});
  stepper.start();
  stepper.evaluate_now();
  const Real before = stepper.energies().sum();
  advance(stepper, static_cast<int>(std::lround(0.04 / step)));
  const auto now = stepper.energies();
  EXPECT_GT(now.dashpot_work + now.sliding_work, 0.05 * (now.translation + now.rotation));
  return std::abs(now.sum() - before) / (now.dashpot_work + now.sliding_work);
}

TEST(clumps, of_several_levels_balance_energy_as_the_finest_step_does) {
  EXPECT_LT(residual_of_a_fall(2e-5, true), 2e-3);
  EXPECT_LT(residual_of_a_fall(5e-6, false), 2e-3);
}

TEST(clumps, give_the_same_bits_on_any_number_of_threads) {
  const auto run = [](int threads, bool levels) {
    parallel::set_threads(threads);
    auto stepper = two_sizes(9, 3, falling(), levels, {Wall{}});  // 2916 spheres: three tiles
    stepper.start();
    advance(stepper, 400);
    EXPECT_GT(stepper.searches(), 2);
    EXPECT_GT(stepper.contacts(), 10);
    parallel::set_threads(1);
    return state_of(stepper);
  };
  for (const bool levels : {false, true}) {
    const auto alone = run(1, levels);
    for (const int threads : {2, 3}) EXPECT_TRUE(run(threads, levels) == alone) << threads << levels;
  }
}

TEST(clumps, go_on_from_a_checkpoint_as_if_nothing_had_been) {
  for (const bool levels : {false, true}) {
    const auto make = [&] { return two_sizes(6, 2, falling(), levels, {Wall{}}); };
    auto through = make(), resumed = make();
    through.start();
    advance(through, 2500);
    test::MemoryArchive checkpoint = state_of(through);
    checkpoint.turn_round();
    resumed.columns(checkpoint);
    advance(through, 800);
    advance(resumed, 800);
    EXPECT_GT(through.contacts(), 3);
    EXPECT_TRUE(state_of(through) == state_of(resumed)) << levels;
  }
}

}  // namespace
}  // namespace sazare::methods::spheres
