#include <gtest/gtest.h>

#include <cmath>

#include "sazare/parallel/threads.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

/// A small sphere strikes a large one off its centre, 1:8.
std::vector<Grain> one_to_eight() {
  Grain large, small;
  large.radius = 0.008;
  large.spin = {0, 5, -3};
  small.radius = 0.001;
  small.centre = {0.0091, 0.0011, -0.0007};
  small.velocity = {-0.5, 0.1, 0.2};
  small.spin = {20, -40, 70};
  return {large, small};
}

/// Spheres of three sizes, 1:2:4, that fall into each other; the levels go from 0 to 2.
std::vector<Grain> three_sizes(int across, Real speed) {
  std::vector<Grain> grains = heap(across, speed, 0.0202);
  for (std::size_t n = 0; n < grains.size(); ++n) grains[n].radius = n % 5 == 0 ? 0.0025 : n % 5 == 1 ? 0.005 : 0.01;
  return grains;
}

std::vector<Wall> floor_and_slope() {
  Wall floor, slope;
  slope.triangles = {{Vector3(-1, -1, 0.0), Vector3(1, -1, 0.0), Vector3(0, 1, 0.01)}};
  return {floor, slope};
}

Rules rough() { return {.restitution = 0.6, .friction = 0.4, .rolling = 0.05, .twisting = 0.02, .step = 4e-5}; }

Rules falling() {
  Rules rules = rough();
  rules.gravity = {0, 0, -9.81};
  return rules;
}

methods::spheres::SphereStepper leveled(const std::vector<Grain>& grains, Rules rules, std::vector<Wall> walls = {}) {
  rules.level = levels_by_radius(grains);
  return make_stepper(grains, rules, std::move(walls));
}

Real difference(const methods::spheres::SphereStepper& one, const methods::spheres::SphereStepper& other, std::size_t count) {
  Real sum = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const auto number = static_cast<Index>(n);
    sum += (velocity_of(one, number) - velocity_of(other, number)).squaredNorm() +
           (centre_of(one, number) - centre_of(other, number)).squaredNorm();
  }
  return std::sqrt(sum);
}

TEST(sphere_levels, all_at_one_level_are_the_steps_of_that_level) {
  Rules rules = rough();
  rules.step = 8e-6;
  rules.level = {2, 2};
  auto leveled = make_stepper(one_to_eight(), rules);
  rules.step = 2e-6;
  rules.level = {};
  auto uniform = make_stepper(one_to_eight(), rules);
  leveled.start();
  uniform.start();
  advance(leveled, 200);
  advance(uniform, 800);
  EXPECT_NE(velocity_of(uniform, 0).norm(), 0);  // they have met
  EXPECT_LT(difference(leveled, uniform, 2), 1e-12);
  EXPECT_LT((spin_of(leveled, 1) - spin_of(uniform, 1)).norm(), 1e-9);
}

/// The motion after a collision in base steps, over that of far smaller steps.
Real error_after_collision(Rules rules, int steps, bool levels) {
  constexpr Real end = 1.6e-3;
  rules.step = end / (64 * 200);
  auto exact = make_stepper(one_to_eight(), rules);
  rules.step = end / steps;
  auto coarse = levels ? leveled(one_to_eight(), rules) : make_stepper(one_to_eight(), rules);
  exact.start();
  coarse.start();
  advance(exact, 64 * 200);
  advance(coarse, steps);
  EXPECT_EQ(coarse.levels().finest(), levels ? 3 : 0);
  EXPECT_EQ(coarse.contacts(), 0);
  EXPECT_GT(velocity_of(coarse, 1).x(), 0);  // it came back
  return difference(coarse, exact, 2) / velocity_of(exact, 1).norm();
}

TEST(sphere_levels, a_collision_of_one_to_eight_is_that_of_the_finest_step) {
  for (const Rules& rules : {Rules{}, rough()}) {
    const Real leveled = error_after_collision(rules, 100, true), uniform = error_after_collision(rules, 800, false);
    EXPECT_LT(leveled, 5e-3);
    EXPECT_LT(leveled, 1.5 * uniform);
  }
}

TEST(sphere_levels, keep_momenta_to_the_last_digits) {
  const auto grains = three_sizes(6, 1);
  auto stepper = leveled(grains, rough());
  stepper.start();
  stepper.evaluate_now();
  const Vector3 momentum = stepper.momentum(), angular = stepper.angular_momentum();
  const Real mass = 8.4e-3 * 216;
  advance(stepper, 200);
  EXPECT_EQ(stepper.levels().finest(), 2);
  EXPECT_GT(stepper.energies().sliding_work, 0);
  EXPECT_LT((stepper.momentum() - momentum).norm(), 1e-13 * mass);
  EXPECT_LT((stepper.angular_momentum() - angular).norm(), 1e-13 * mass * 0.1);
}

/// Residual of the energy balance after a fall onto the floor, over what was lost.
Real residual(Real step) {
  Rules rules = falling();
  rules.step = step;
  const auto grains = three_sizes(5, 0.3);
  auto stepper = leveled(grains, rules, {Wall{}});
  stepper.start();
  stepper.evaluate_now();
  const Real before = stepper.energies().sum();
  advance(stepper, static_cast<int>(std::lround(0.02 / step)));
  const auto now = stepper.energies();
  EXPECT_GT(now.dashpot_work + now.sliding_work, 0.3 * (now.translation + now.rotation));
  return std::abs(now.sum() - before) / (now.dashpot_work + now.sliding_work);
}

TEST(sphere_levels, the_energy_balance_closes_with_the_square_of_the_step) {
  const Real coarse = residual(4e-5), fine = residual(1e-5);
  EXPECT_LT(coarse, 0.02);
  EXPECT_LT(fine, coarse / 8);
}

TEST(sphere_levels, a_pile_at_rest_stays_at_rest) {
  // A large sphere between two small ones on the floor, in a trough.
  Rules rules = falling();
  rules.friction = 0.5;
  rules.restitution = 0.3;
  Grain large, left, right;
  large.radius = 0.01;
  large.centre = {0, 0, 0.01};
  left.radius = right.radius = 0.002;
  left.centre = {-0.00895, 0, 0.002};
  right.centre = {0.00895, 0, 0.002};
  Wall floor, one, other;
  one.normal = Vector3::UnitX();
  one.point = Vector3(-0.01095, 0, 0);
  other.normal = -Vector3::UnitX();
  other.point = Vector3(0.01095, 0, 0);
  auto stepper = leveled({large, left, right}, rules, {floor, one, other});
  stepper.start();
  advance(stepper, 10000);
  const auto energies = stepper.energies();
  EXPECT_LT(energies.translation + energies.rotation, 1e-12 * energies.potential);
  Vector3 force = Vector3::Zero();
  for (const auto& load : stepper.walls().loads()) force += load.force;
  const Real weight = 9.81 * 2500 * 4.18879020478639 * (1e-6 + 2 * 8e-9);
  EXPECT_NEAR(force.z(), -weight, 1e-6 * weight);
}

TEST(sphere_levels, evaluate_less_than_the_finest_step_for_all) {
  auto grains = heap(8, 0.5, 0.0202);
  grains[77].radius = 0.00125;
  Rules rules = falling();
  rules.level.assign(grains.size(), 0);
  rules.level[77] = 3;
  auto stepper = make_stepper(grains, rules, {Wall{}});
  stepper.start();
  advance(stepper, 300);
  const auto& counts = stepper.levels().counts();
  EXPECT_EQ(stepper.levels().finest(), 3);
  EXPECT_GT(stepper.contacts(), 30);
  EXPECT_LT(counts.evaluations, counts.uniform_evaluations / 5);
  EXPECT_LT(counts.kicks, 300 * 512 * 8 / 5);
  EXPECT_FALSE(stepper.missed_pairs());
}

/// A held plate of large spheres goes down onto small ones that lie on the floor: the residual of the energy balance, over its work.
Real residual_of_a_press(int steps) {
  Rules rules = rough();
  std::vector<Grain> grains;
  for (int n = 0; n < 4; ++n) {
    Grain small, large;
    small.radius = 0.002;
    small.centre = {0.02 * n, 0, 0.002};
    large.radius = 0.01;
    large.centre = {0.02 * n + 0.001, 0, 0.0141};
    grains.push_back(small);
    grains.push_back(large);
  }
  state::Spheres spheres;
  for (const Grain& grain : grains) {
    spheres.add(grain.centre, grain.radius, 2500, 0, grain.radius > 0.005);
    if (grain.radius > 0.005) spheres.set_motion(spheres.size() - 1, {0, 0, -0.05}, Vector3::Zero());
  }
  methods::spheres::SphereStepper stepper(std::move(spheres), table(rules), {Wall{}},
                                {4e-3 / steps, Vector3::Zero(), 1e-3, 5e-3, levels_by_radius(grains)});
  stepper.start();
  stepper.evaluate_now();
  const Real before = stepper.energies().sum();
  advance(stepper, steps);
  const auto now = stepper.energies();
  EXPECT_GT(now.wall_work, 0);
  return std::abs(now.sum() - before) / now.wall_work;
}

TEST(sphere_levels, what_is_driven_brings_its_work_in) {
  const Real coarse = residual_of_a_press(400), fine = residual_of_a_press(1600);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_LT(fine, coarse / 3);  // contacts begin and slip within it
}

TEST(sphere_levels, tell_when_spheres_may_have_met_unseen) {
  // Two small ones that stand half within each other fly apart; the large one is far from them when pairs are sought.
  Rules rules;
  rules.step = 4e-5;
  rules.margin = 1e-5;
  auto grains = one_to_eight();
  for (Grain& grain : grains) grain.velocity = grain.spin = Vector3::Zero();
  grains.push_back(grains[1]);
  grains[1].centre.x() = 0.0093;
  grains[2].centre.x() = 0.0103;
  auto stepper = leveled(grains, rules);
  stepper.start();
  EXPECT_FALSE(stepper.missed_pairs());
  advance(stepper, 1);
  EXPECT_TRUE(stepper.missed_pairs());
}

test::MemoryArchive state_of(methods::spheres::SphereStepper& stepper) {
  test::MemoryArchive archive;
  stepper.columns(archive);
  return archive;
}

TEST(sphere_levels, give_the_same_bits_on_any_number_of_threads) {
  const auto run = [](int threads) {
    parallel::set_threads(threads);
    auto stepper = leveled(three_sizes(16, 0.5), falling(), floor_and_slope());  // four tiles
    stepper.start();
    advance(stepper, 60);
    EXPECT_GT(stepper.searches(), 2);
    EXPECT_GT(stepper.contacts(), 100);
    parallel::set_threads(1);
    return state_of(stepper);
  };
  const auto alone = run(1);
  for (const int threads : {2, 3}) EXPECT_TRUE(run(threads) == alone) << threads;
}

TEST(sphere_levels, go_on_from_a_checkpoint_as_if_nothing_had_been) {
  const auto grains = three_sizes(8, 0.5);
  for (const bool settled : {false, true}) {
    auto through = leveled(grains, falling(), floor_and_slope()), resumed = leveled(grains, falling(), floor_and_slope());
    through.start();
    advance(through, 150);
    if (!settled) through.advance();
    test::MemoryArchive checkpoint = state_of(through);
    checkpoint.turn_round();
    resumed.columns(checkpoint);
    advance(through, 150);
    advance(resumed, 150);
    EXPECT_GT(through.contacts(), 10);
    EXPECT_TRUE(state_of(through) == state_of(resumed)) << settled;
  }
}

}  // namespace
}  // namespace sazare::methods::spheres
