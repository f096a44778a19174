/// Spheres and clumps in water: sinking, floating and terminal velocity against closed forms, the energy balance, and the same bits.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/parallel/threads.hpp"
#include "scene.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::spheres {
namespace {

constexpr Real g = 10, grain_density = 2500, pi = std::numbers::pi;
const Vector3 down{0, 0, -g};

laws::WaterField still() {
  laws::WaterField water;
  water.gravity = g;
  return water;
}

laws::WaterField waves() {
  laws::WaterField water = still();
  water.bed = -2;
  water.wave.emplace(laws::PlaneWave::Given{
      .theory = laws::WaveTheory::stokes2, .height = 0.05, .period = 0.8, .depth = 2, .ramp = 0.1, .gravity = g});
  return water;
}

laws::BodyInWater ball(Real radius, std::optional<Real> drag = 0.44) {
  return {.radius = radius,
          .volume = 4 * pi / 3 * radius * radius * radius,
          .area = pi * radius * radius,
          .drag_coefficient = drag};
}

std::vector<laws::BodyInWater> balls(const state::Spheres& spheres, std::optional<Real> drag = 0.44) {
  std::vector<laws::BodyInWater> bodies;
  for (const auto& place : spheres.place) bodies.push_back(ball(place.radius, drag));
  return bodies;
}

SphereStepper in_water(const std::vector<Grain>& grains, const Rules& rules, const laws::WaterField& water, std::vector<Wall> walls = {},
                       std::optional<Real> drag = 0.44) {
  auto stepper = make_stepper(grains, rules, std::move(walls));
  stepper.set_water({water, balls(stepper.spheres(), drag)});
  return stepper;
}

/// v = v_t tanh(t/T), with the terminal velocity v_t and T = (m + m_a) v_t/((m - rho V) g).
Real sunk_speed(Real radius, Real time) {
  const laws::BodyInWater body = ball(radius);
  const Real mass = grain_density * body.volume, weight = (grain_density - 1000) * body.volume * g,
             terminal = std::sqrt(weight / (0.5 * 1000 * 0.44 * body.area));
  return terminal * std::tanh(time * weight / ((mass + 500 * body.volume) * terminal));
}

TEST(water, a_sphere_sinks_as_the_closed_form_says_to_second_order) {
  const auto error = [](Real step) {
    auto stepper = in_water({{.centre = {0, 0, -1}}}, {.step = step, .gravity = down}, still());
    stepper.start();
    advance(stepper, static_cast<int>(std::lround(0.064 / step)));
    return velocity_of(stepper, 0).z() + sunk_speed(0.01, 0.064);
  };
  EXPECT_LT(std::abs(error(1e-3)), 1e-4 * sunk_speed(0.01, 0.064));
  EXPECT_NEAR(error(2e-3) / error(1e-3), 4, 0.2);
}

TEST(water, a_small_sphere_comes_to_the_velocity_of_stokes) {
  auto stepper = in_water({{.centre = {0, 0, -1}, .radius = 5e-6}}, {.step = 1e-6, .gravity = down}, still(), {}, std::nullopt);
  stepper.start();
  advance(stepper, 500);
  EXPECT_NEAR(velocity_of(stepper, 0).z() / (-2.0 / 9 * 1500 * g * 25e-12 / 1e-3), 1, 0.01);  // inertia of the flow: Re^0.687
}

TEST(water, what_is_as_dense_as_water_stays) {
  laws::WaterField water = still();
  water.density = grain_density;
  auto stepper = in_water({{.centre = {0, 0, -1}}}, {.step = 1e-3, .gravity = down}, water);
  stepper.start();
  advance(stepper, 1000);
  EXPECT_NEAR(centre_of(stepper, 0).z(), -1, 1e-12);
}

TEST(water, what_floats_goes_up_and_down_with_its_natural_period) {
  laws::WaterField water = still();
  water.density = 2 * grain_density;  // half of it is under water
  const Real radius = 0.01, start = 1e-5;
  auto stepper = in_water({{.centre = {0, 0, start}}}, {.step = 1e-4, .gravity = down}, water, {}, 0.0);
  const Real volume = 4 * pi / 3 * 1e-6, mass = grain_density * volume + 0.5 * water.density * volume / 2;
  const Real period = 2 * pi * std::sqrt(mass / (water.density * g * pi * radius * radius));
  stepper.start();
  advance(stepper, static_cast<int>(std::lround(period / 1e-4)));
  EXPECT_NEAR(centre_of(stepper, 0).z() / start, 1, 1e-3);
}

TEST(water, a_body_at_rest_on_the_bed_weighs_what_it_does_in_water) {
  laws::WaterField water = still();
  water.level = 1;
  auto stepper = in_water({{.centre = {0, 0, 0.0099}}}, {.restitution = 0.2, .step = 2e-5, .gravity = down}, water, {Wall{}});
  stepper.start();
  advance(stepper, 40000);
  const Real volume = 4 * pi / 3 * 1e-6;
  EXPECT_NEAR(stepper.walls().loads().front().force.z(), -1500 * volume * g, 1e-9);
  EXPECT_NEAR(stepper.load(place_of(stepper, 0)).fz, grain_density * volume * g, 1e-9);
}

/// Grains that fall through waves onto a floor below and meet.
SphereStepper rain_of_grains(Rules rules, int across) {
  std::vector<Grain> grains = heap(across, 0.5, 0.0195);
  for (Grain& grain : grains) grain.centre.z() -= 0.05;
  if (!rules.level.empty()) rules.level.assign(grains.size(), rules.level.front());
  Wall floor;
  floor.point = {0, 0, -0.06};
  return in_water(grains, rules, waves(), {floor}, std::nullopt);
}

TEST(water, energy_balances_to_second_order) {
  const auto residual = [](Real step, int steps) {
    auto stepper = rain_of_grains({.step = step, .gravity = down}, 6);
    stepper.start();
    stepper.evaluate_now();
    const Real before = stepper.energies().sum();
    EXPECT_EQ(stepper.energies().water_work, 0);
    advance(stepper, steps);
    EXPECT_GT(std::abs(stepper.energies().water_work), 1e-3);
    return std::abs(stepper.energies().sum() - before) / std::abs(stepper.energies().water_work);
  };
  EXPECT_LT(residual(1e-5, 20000), 1e-4);
}

TEST(water, a_sphere_that_crosses_the_surface_keeps_the_energy_balance) {
  const auto residual = [](Real step) {
    auto stepper = in_water({{.centre = {0, 0, 0.05}, .velocity = {0.3, 0, -1}}}, {.step = step, .gravity = down}, waves());
    stepper.start();
    stepper.evaluate_now();
    const Real before = stepper.energies().sum();
    advance(stepper, static_cast<int>(std::lround(0.1 / step)));
    EXPECT_LT(centre_of(stepper, 0).z(), -0.02);
    return std::abs(stepper.energies().sum() - before) / 0.001;
  };
  EXPECT_LT(residual(1e-5), 2e-4);
}

TEST(water, one_level_for_all_gives_what_that_step_does) {
  auto leveled = rain_of_grains({.step = 4e-5, .gravity = down, .level = {2}}, 5);
  auto uniform = rain_of_grains({.step = 1e-5, .gravity = down}, 5);
  leveled.start();
  uniform.start();
  advance(leveled, 500);
  advance(uniform, 2000);
  for (Index n = 0; n < 125; ++n) EXPECT_LT((centre_of(leveled, n) - centre_of(uniform, n)).norm(), 1e-11);
  EXPECT_NEAR(leveled.energies().water_work, uniform.energies().water_work, 1e-3 * std::abs(uniform.energies().water_work));
}

test::MemoryArchive state_of(SphereStepper& stepper) {
  test::MemoryArchive archive;
  stepper.columns(archive);
  return archive;
}

TEST(water, gives_the_same_bits_on_any_number_of_threads) {
  const auto run = [](int threads) {
    parallel::set_threads(threads);
    auto stepper = rain_of_grains({.step = 1e-5, .gravity = down}, 21);
    stepper.start();
    advance(stepper, 100);
    parallel::set_threads(1);
    return state_of(stepper);
  };
  const auto alone = run(1);
  for (const int threads : {2, 3}) EXPECT_TRUE(run(threads) == alone) << threads;
}

/// A clump of one ball in the middle, or of two beside each other.
struct Pair {
  state::Spheres spheres;
  state::Clumps clumps;

  explicit Pair(std::vector<Vector3> arms, const Vector3& centre, Real density = grain_density) {
    const Real volume = 4 * pi / 3 * 1e-6 * static_cast<Real>(arms.size());
    state::Clump clump;
    clump.centre = centre;
    clump.mass = density * volume;
    clump.volume = volume;
    clump.inertia = Vector3::Constant(0.4 * clump.mass * 1e-4);
    clumps.clumps.push_back(clump);
    for (const Vector3& arm : arms) {
      clumps.members.push_back({static_cast<Index>(spheres.size()), 0, arm});
      spheres.add(centre + arm, 0.01, density, 0, true);
      spheres.place.back().mass = clump.mass;
    }
  }

  SphereStepper stepper(const Rules& rules, const laws::WaterField& water, std::optional<Real> drag = 0.44) const {
    SphereStepper stepper{spheres, table(rules), {}, {rules.step, rules.gravity, rules.margin, 5e-3, rules.level}, {}, clumps};
    stepper.set_water({water, balls(spheres, drag)});
    return stepper;
  }
};

TEST(water, a_clump_of_one_ball_moves_as_the_ball) {
  const Rules rules{.step = 1e-3, .gravity = down};
  auto clump = Pair({Vector3::Zero()}, {0, 0, 0.05}).stepper(rules, waves());
  auto sphere = in_water({{.centre = {0, 0, 0.05}}}, rules, waves());
  clump.start();
  sphere.start();
  advance(clump, 300);
  advance(sphere, 300);
  EXPECT_LT(centre_of(sphere, 0).z(), -0.05);
  EXPECT_LT((centre_of(clump, 0) - centre_of(sphere, 0)).norm(), 1e-13);
  EXPECT_NEAR(clump.energies().water_work, sphere.energies().water_work, 1e-13);
}

TEST(water, a_clump_rights_itself_and_its_energy_balances) {
  laws::WaterField water = still();
  water.density = 1.5 * grain_density;
  water.viscosity = 1;
  const Rules rules{.step = 1e-4, .gravity = down};
  auto stepper = Pair({{0.008, 0, 0.002}, {-0.008, 0, -0.002}}, {0, 0, 0.001}).stepper(rules, water, std::nullopt);
  stepper.start();
  stepper.evaluate_now();
  const Real before = stepper.energies().sum(), stands = stepper.energies().potential;
  advance(stepper, 100000);
  // It lies level, and as deep as its weight asks for.
  EXPECT_NEAR(centre_of(stepper, 0).z(), centre_of(stepper, 1).z(), 1e-4);
  EXPECT_NEAR(laws::submerged_share(centre_of(stepper, 0).z(), 0.01, 0), 1 / 1.5, 1e-3);
  EXPECT_NEAR(stepper.energies().sum(), before, 1e-3 * std::abs(stands - stepper.energies().potential));
}

TEST(water, goes_on_from_a_checkpoint_as_if_nothing_had_been) {
  const Pair pair({{0.008, 0, 0}, {-0.008, 0, 0.003}}, {0, 0, 0.005});
  const Rules rules{.step = 1e-4, .gravity = down};
  for (const bool holds_forces : {false, true}) {
    auto through = pair.stepper(rules, waves()), resumed = pair.stepper(rules, waves());
    through.start();
    for (int k = 0; k < 321; ++k) through.advance();
    if (holds_forces) through.evaluate_now();
    test::MemoryArchive checkpoint = state_of(through);
    checkpoint.turn_round();
    resumed.columns(checkpoint);
    advance(through, 200);
    advance(resumed, 200);
    EXPECT_TRUE(state_of(through) == state_of(resumed)) << holds_forces;
  }
}

}  // namespace
}  // namespace sazare::methods::spheres
