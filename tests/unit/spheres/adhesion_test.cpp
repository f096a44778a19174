/// Spheres that stick to each other and to walls.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/parallel/threads.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

constexpr Real radius = 0.01, surface_energy = 10, mass = 2500 * 4.18879020478639e-6;

Rules sticky(Real restitution = 1, Real step = 1e-6) {
  return {.restitution = restitution, .step = step, .model = laws::ContactModel::jkr, .surface_energy = surface_energy};
}

laws::ContactConstants<Real> constants() { return table(sticky()).of(0, 0); }

/// The speed below which a reduced mass sticks, where dashpots take nothing.
Real sticking_speed(Real reduced_mass, Real reduced_radius) {
  return std::sqrt(2 * laws::Jkr::parting_loss(constants(), reduced_radius) / reduced_mass);
}

SphereStepper two_that_meet(Real speed, Real step = 1e-6) {
  return make_stepper({{.centre = {-radius - 1e-5, 0, 0}, .velocity = {0.5 * speed, 0, 0}},
                       {.centre = {radius + 1e-5, 0, 0}, .velocity = {-0.5 * speed, 0, 0}}},
                      sticky(1, step));
}

TEST(adhesion, slow_spheres_stick_together) {
  const Real speed = 0.97 * sticking_speed(0.5 * mass, 0.5 * radius);
  auto stepper = two_that_meet(speed);
  stepper.start();
  advance(stepper, static_cast<int>(2e-5 / speed / 1e-6) + 10);
  EXPECT_EQ(stepper.contacts(), 1);
  Real widest = 0;
  for (int n = 0; n < 300; ++n) {
    advance(stepper, 50);
    ASSERT_EQ(stepper.contacts(), 1);
    widest = std::max(widest, centre_of(stepper, 1).x() - centre_of(stepper, 0).x() - 2 * radius);
  }
  EXPECT_GT(widest, 0.3 * laws::Jkr::neck(constants(), 0.5 * radius));
  EXPECT_EQ(stepper.energies().dashpot_work, 0);
}

/// What rebounds has lost the energy of the neck, and the energy balance has it.
TEST(adhesion, fast_spheres_rebound_slower) {
  const Real sticking = sticking_speed(0.5 * mass, 0.5 * radius);
  for (const Real times : {1.03, 1.5, 5.0}) {
    const Real speed = times * sticking;
    auto stepper = two_that_meet(speed, 5e-7);
    stepper.start();
    const Real before = stepper.energies().sum();
    advance(stepper, 60000);
    EXPECT_EQ(stepper.contacts(), 0);
    const Real after = velocity_of(stepper, 1).x() - velocity_of(stepper, 0).x(), loss = 0.25 * mass * sticking * sticking;
    EXPECT_NEAR(after * after, speed * speed - sticking * sticking, 5e-3 * speed * speed) << times;
    EXPECT_NEAR(stepper.energies().dashpot_work, loss, 1e-12 * loss);
    EXPECT_EQ(stepper.energies().elastic, 0);
    EXPECT_NEAR(stepper.energies().sum(), before, 5e-3 * before);
  }
}

TEST(adhesion, keeps_momentum_and_angular_momentum) {
  Rules rules = sticky(0.7, 1e-5);
  rules.friction = 0.4;
  rules.rolling = 0.1;
  rules.twisting = 0.05;
  auto stepper = make_stepper(heap(6, 0.2), rules);
  stepper.start();
  const Vector3 momentum = stepper.momentum(), turning = stepper.angular_momentum();
  advance(stepper, 4000);
  EXPECT_GT(stepper.contacts(), 10);
  EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-15);
  EXPECT_LT((stepper.angular_momentum() - turning).norm(), 1e-15);
}

/// The residual of the energy balance falls with the step.
TEST(adhesion, the_energy_balance_closes) {
  const auto residual = [](Real step) {
    Rules rules = sticky(0.6, step);
    rules.friction = 0.4;
    auto stepper = make_stepper(heap(5, 0.2), rules);
    stepper.start();
    const SphereEnergies first = stepper.energies();
    advance(stepper, static_cast<int>(std::round(0.04 / step)));
    const SphereEnergies last = stepper.energies();
    EXPECT_GT(last.dashpot_work, 0.02 * first.sum());
    return std::abs(last.sum() - first.sum()) / first.sum();
  };
  EXPECT_LT(residual(1e-5), 2e-2);
  EXPECT_LT(residual(1e-6), 2e-3);
}

test::MemoryArchive state_of(SphereStepper& stepper) {
  test::MemoryArchive archive;
  stepper.columns(archive);
  return archive;
}

std::vector<Wall> walls() {
  Wall floor, slope;
  slope.triangles = {{Vector3(-1, -1, 0.0), Vector3(1, -1, 0.0), Vector3(0, 1, 0.01)}};
  return {floor, slope};
}

Rules falling() {
  Rules rules = sticky(0.6, 1e-5);
  rules.friction = 0.4;
  rules.rolling = 0.05;
  rules.gravity = {0, 0, -9.81};
  return rules;
}

TEST(adhesion, gives_the_same_bits_on_any_number_of_threads) {
  const auto run = [](int threads) {
    parallel::set_threads(threads);
    auto stepper = make_stepper(heap(16, 0.2, 0.0195), falling(), walls());
    stepper.start();
    advance(stepper, 400);
    EXPECT_GT(stepper.searches(), 1);
    EXPECT_GT(stepper.contacts(), 300);
    parallel::set_threads(1);
    return state_of(stepper);
  };
  const auto alone = run(1);
  for (const int threads : {2, 5}) EXPECT_TRUE(run(threads) == alone) << threads;
}

/// With necks between spheres and to both kinds of walls.
TEST(adhesion, goes_on_from_a_checkpoint_as_if_nothing_had_been) {
  auto through = make_stepper(heap(8, 0.2, 0.0195), falling(), walls()),
       resumed = make_stepper(heap(8, 0.2, 0.0195), falling(), walls());
  through.start();
  advance(through, 1500);
  test::MemoryArchive checkpoint = state_of(through);
  checkpoint.turn_round();
  resumed.columns(checkpoint);
  advance(through, 700);
  advance(resumed, 700);
  EXPECT_GT(through.contacts(), 100);
  EXPECT_TRUE(state_of(through) == state_of(resumed));
}

Wall ceiling(bool of_triangles) {
  Wall wall;
  wall.normal = -Vector3::UnitZ();
  if (of_triangles) wall.triangles = {{Vector3(-1, -1, 0), Vector3(1, -1, 0), Vector3(0, 2, 0)}};
  return wall;
}

/// A sphere that hangs from a ceiling by a neck, while another one that flies about lets neighbours be sought again and again.
TEST(adhesion, a_sphere_hangs_from_a_ceiling_up_to_the_pull_off_force) {
  const Real pull_off = 1.5 * std::numbers::pi * surface_energy * radius;
  for (const bool of_triangles : {false, true})
    for (const Real load : {0.95, 1.02}) {
      Rules rules = sticky(0.3, 2e-6);
      rules.gravity = {0, 0, -load * pull_off / mass};
      auto stepper = make_stepper({{.centre = {0, 0, -radius + 1e-9}}, {.centre = {0.5, 0, -0.5}, .velocity = {3, 0, 0}}}, rules,
                                  {ceiling(of_triangles)});
      stepper.start();
      advance(stepper, 20000);
      EXPECT_GT(stepper.searches(), 20);
      const Real gap = -centre_of(stepper, 0).z() - radius, neck = laws::Jkr::neck(constants(), radius);
      if (load < 1) {
        EXPECT_EQ(stepper.contacts(), 1);
        EXPECT_GT(gap, 0.1 * neck);
        EXPECT_LT(gap, neck);
        EXPECT_NEAR(stepper.walls().loads()[0].force.z(), -load * pull_off, 1e-3 * pull_off);
      } else {
        EXPECT_EQ(stepper.contacts(), 0);
        EXPECT_GT(gap, 1e-3);
        EXPECT_NEAR(stepper.energies().dashpot_work, laws::Jkr::parting_loss(constants(), radius),
                    0.5 * laws::Jkr::parting_loss(constants(), radius));  // and what the dashpot took
      }
    }
}

/// Who has not touched feels nothing, however near.
TEST(adhesion, begins_when_surfaces_meet) {
  const Real neck = laws::Jkr::neck(constants(), radius);
  for (const bool of_triangles : {false, true}) {
    auto stepper = make_stepper({{.centre = {0, 0, -radius - 0.3 * neck}}}, sticky(), {ceiling(of_triangles)});
    stepper.start();
    EXPECT_EQ(stepper.contacts(), 0);
    advance(stepper, 100);
    EXPECT_EQ(velocity_of(stepper, 0), Vector3(Vector3::Zero()));
  }
  auto pair = make_stepper({{.centre = {0, 0, 0}}, {.centre = {2 * radius + 0.3 * neck, 0, 0}}}, sticky());
  pair.start();
  advance(pair, 100);
  EXPECT_EQ(pair.contacts(), 0);
  EXPECT_EQ(velocity_of(pair, 1), Vector3(Vector3::Zero()));
}

TEST(adhesion, a_sphere_sticks_to_a_wall_or_rebounds) {
  const Real sticking = sticking_speed(mass, radius);
  for (const bool of_triangles : {false, true})
    for (const Real times : {0.97, 1.2}) {
      const Real speed = times * sticking;
      auto stepper = make_stepper({{.centre = {0, 0, -radius - 1e-6}, .velocity = {0, 0, speed}}}, sticky(1, 5e-7),
                                  {ceiling(of_triangles)});
      stepper.start();
      advance(stepper, 40000);
      EXPECT_EQ(stepper.contacts(), times < 1 ? 1 : 0);
      if (times < 1) continue;
      EXPECT_NEAR(std::pow(velocity_of(stepper, 0).z(), 2), speed * speed - sticking * sticking, 5e-3 * speed * speed);
      EXPECT_NEAR(stepper.energies().dashpot_work, 0.5 * mass * sticking * sticking, 1e-12 * mass * sticking * sticking);
    }
}

/// The constants of several materials are looked up where one asks who holds.
TEST(adhesion, of_equal_materials_is_that_of_one) {
  const auto run = [](Index materials) {
    ContactTable contacts(laws::ContactModel::jkr, materials);
    for (Index one = 0; one < materials; ++one)
      for (Index other = 0; other <= one; ++other) contacts.set(one, other, table(falling()).of(0, 0));
    state::Spheres spheres;
    for (const Grain& grain : heap(6, 0.2, 0.0195)) {
      spheres.add(grain.centre, grain.radius, 2500, static_cast<Index>(spheres.size()) % materials);
      spheres.set_motion(spheres.size() - 1, grain.velocity, grain.spin);
    }
    SphereStepper stepper(std::move(spheres), contacts, walls(), {1e-5, falling().gravity, 1e-3, 5e-3, {}});
    stepper.start();
    advance(stepper, 1500);
    EXPECT_GT(stepper.contacts(), 30);
    return std::pair(centre_of(stepper, 100), stepper.energies().dashpot_work);
  };
  EXPECT_EQ(run(1), run(3));
}

}  // namespace
}  // namespace sazare::methods::spheres
