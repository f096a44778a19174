#include "sazare/methods/spheres/stepper/work_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "sazare/parallel/threads.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

std::vector<ContactSums> sums_of_tiles() {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<Real> number(-1, 1);
  std::uniform_int_distribution<int> exponent(-80, 40);
  std::vector<ContactSums> tiles(500);
  for (ContactSums& tile : tiles) {
    for (Real* one : {&tile.elastic, &tile.sliding, &tile.dashpot_work, &tile.sliding_work, &tile.bonds, &tile.bond_drag,
                      &tile.fracture, &tile.water_work, &tile.applied_work, &tile.carried_energy, &tile.wall_work})
      *one = std::ldexp(number(random), exponent(random));
    tile.contacts = 3;
    tile.broken = 1;
  }
  return tiles;
}

test::MemoryArchive columns_of(WorkSums sums) {
  test::MemoryArchive archive;
  sums.columns(archive);
  return archive;
}

WorkSums sum_of(std::span<const ContactSums> tiles) {
  WorkSums sums;
  for (const ContactSums& tile : tiles) {
    sums.add(tile);
    sums.hold(tile);
  }
  return sums;
}

TEST(work_sums, have_the_same_bits_in_any_order_and_in_any_parts) {
  std::vector<ContactSums> tiles = sums_of_tiles();
  const WorkSums expected = sum_of(tiles);
  EXPECT_EQ(expected.contacts, 1500);
  EXPECT_EQ(expected.broken, 500);
  std::mt19937_64 random(5);
  for (const std::size_t cut : {std::size_t{1}, std::size_t{123}, std::size_t{499}}) {
    std::ranges::shuffle(tiles, random);
    WorkSums total = sum_of(std::span(tiles).first(cut));
    WorkSums more;  // as another rank would send it
    const WorkSums sent = sum_of(std::span(tiles).subspan(cut));
    std::memcpy(static_cast<void*>(&more), &sent, sizeof sent);
    total += more;
    EXPECT_TRUE(columns_of(total) == columns_of(expected));
    const SphereEnergies energies = energies_of(total, {}), all = energies_of(expected, {});
    EXPECT_EQ(energies.sum(), all.sum());
    EXPECT_EQ(energies.water_work, all.water_work);
  }
}

TEST(work_sums, go_on_from_a_checkpoint) {
  const std::vector<ContactSums> tiles = sums_of_tiles();
  test::MemoryArchive checkpoint = columns_of(sum_of(std::span(tiles).first(200)));
  checkpoint.turn_round();
  WorkSums resumed;
  resumed.columns(checkpoint);
  for (const ContactSums& tile : std::span(tiles).subspan(200)) {
    resumed.add(tile);
    resumed.hold(tile);
  }
  EXPECT_TRUE(columns_of(resumed) == columns_of(sum_of(tiles)));
}

TEST(work_sums, take_half_of_the_first_and_the_last_work_of_water) {
  WorkSums sums;
  const auto step = [&](Real work) {
    const ContactSums tile{.water_work = work, .applied_work = 10 * work};
    sums.add(tile);
    sums.hold_nothing();
    sums.hold(tile);
  };
  step(4);
  sums.begin({});
  EXPECT_EQ(energies_of(sums, {}).water_work, 0);
  step(3);
  step(2);
  EXPECT_EQ(energies_of(sums, {}).water_work, 2 + 3 + 1);
  EXPECT_EQ(energies_of(sums, {}).applied_work, 60);
}

TEST(work_sums, of_loads_on_walls_have_the_same_bits_in_any_order_and_in_any_parts) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<Real> number(-1e3, 1e3);
  const auto some = [&] { return Vector3(number(random), 1e-9 * number(random), 1e9 * number(random)); };
  std::vector<WallLoad> loads;
  for (int tile = 0; tile < 300; ++tile) loads.push_back({some(), some(), number(random)});
  const auto sum = [](std::span<const WallLoad> of) {
    WallLoadSums sums;
    for (const WallLoad& load : of) sums += load;
    return sums;
  };
  const WallLoad expected = sum(loads).load();
  std::ranges::shuffle(loads, random);
  WallLoadSums total = sum(std::span(loads).subspan(77));
  total += sum(std::span(loads).first(77));
  EXPECT_EQ(total.load().force, expected.force);
  EXPECT_EQ(total.load().moment, expected.moment);
  EXPECT_EQ(total.load().work, expected.work);
}

/// What a heap that falls apart has, told of the same spheres in any order.
struct Motion {
  SphereEnergies energies;
  Vector3 momentum, angular_momentum;
};

Motion motion_of(const std::vector<Grain>& grains, int threads) {
  parallel::set_threads(threads);
  auto stepper = make_stepper(grains, {.step = 1e-5, .gravity = {0, 0, -9.81}});
  stepper.start();
  advance(stepper, 20);
  EXPECT_EQ(stepper.contacts(), 0);
  parallel::set_threads(1);
  return {stepper.energies(), stepper.momentum(), stepper.angular_momentum()};
}

TEST(motion_sums, have_the_same_bits_for_spheres_in_any_order_on_any_number_of_threads) {
  std::vector<Grain> grains = heap(15, 0.5, 0.05);  // 3375 spheres: four tiles
  const Motion expected = motion_of(grains, 1);
  EXPECT_GT(expected.energies.translation, 0);
  std::mt19937_64 random(13);
  for (const int threads : {1, 2, 7}) {
    std::ranges::shuffle(grains, random);
    const Motion motion = motion_of(grains, threads);
    EXPECT_EQ(motion.energies.translation, expected.energies.translation);
    EXPECT_EQ(motion.energies.rotation, expected.energies.rotation);
    EXPECT_EQ(motion.energies.potential, expected.energies.potential);
    EXPECT_EQ(motion.momentum, expected.momentum);
    EXPECT_EQ(motion.angular_momentum, expected.angular_momentum);
  }
}

}  // namespace
}  // namespace sazare::methods::spheres
