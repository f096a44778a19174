/// Waves against what every wave must be, and what water does to bodies against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sazare/laws/water/body_in_water.hpp"

namespace sazare::laws {
namespace {

constexpr Real g = 9.81, pi = std::numbers::pi;

PlaneWave wave_of(WaveTheory theory, Real height, Real period, Real depth) {
  return PlaneWave({.theory = theory, .height = height, .period = period, .depth = depth, .gravity = g});
}

/// Differences of a velocity over small distances: of a flow without divergence and rotation u_x + w_z = 0, u_z = w_x.
struct Gradients {
  Real u_x, u_z, w_x, w_z, u_t, w_t;
};

Gradients gradients(const PlaneWave& wave, Real x, Real z, Real t) {
  constexpr Real d = 1e-4;
  const auto at = [&](Real dx, Real dz, Real dt) { return wave.at({x + dx, 0, 0}, z + dz, t + dt).velocity; };
  const auto slope = [&](const Vector3& more, const Vector3& less) -> Vector3 { return (more - less) / (2 * d); };
  const Vector3 along = slope(at(d, 0, 0), at(-d, 0, 0)), up = slope(at(0, d, 0), at(0, -d, 0)), on = slope(at(0, 0, d), at(0, 0, -d));
  return {along.x(), up.x(), along.z(), up.z(), on.x(), on.z()};
}

TEST(waves, the_wave_number_solves_the_dispersion_relation) {
  for (const Real depth : {0.1, 1.0, 10.0, 1000.0})
    for (const Real period : {1.0, 5.0, 12.0, 60.0}) {
      const Real w = 2 * pi / period, k = wave_number(w, depth, g);
      EXPECT_NEAR(g * k * std::tanh(k * depth) / (w * w), 1, 1e-13) << depth << " " << period;
    }
}

TEST(waves, limits_of_the_wave_number) {
  EXPECT_NEAR(wave_number(2 * pi / 5, 1000, g), 4 * pi * pi / (25 * g), 1e-12);           // deep: L = g T^2/(2 pi)
  EXPECT_NEAR(wave_number(2 * pi / 1000, 1, g) / (2 * pi / 1000 / std::sqrt(g)), 1, 1e-5);  // shallow: L = T sqrt(g d)
}

TEST(waves, stokes_flow_has_neither_divergence_nor_rotation_nor_flow_through_the_bed) {
  const PlaneWave wave = wave_of(WaveTheory::stokes2, 1, 6, 5);
  for (const Real x : {0.0, 3.0, 11.0}) {
    const Gradients of = gradients(wave, x, -2, 1.3);
    EXPECT_NEAR(of.u_x + of.w_z, 0, 1e-8);
    EXPECT_NEAR(of.u_z - of.w_x, 0, 1e-8);
    EXPECT_NEAR(wave.at({x, 0, 0}, -5, 1.3).velocity.z(), 0, 1e-14);
  }
}

TEST(waves, acceleration_of_stokes_is_that_of_a_water_particle) {
  const PlaneWave wave = wave_of(WaveTheory::stokes2, 1, 6, 5);
  for (const Real x : {0.0, 3.0, 11.0}) {
    const WaterMotion at = wave.at({x, 0, 0}, -1.5, 0.7);
    const Gradients of = gradients(wave, x, -1.5, 0.7);
    const Vector3& v = at.velocity;
    EXPECT_NEAR(at.acceleration.x(), of.u_t + v.x() * of.u_x + v.z() * of.u_z, 1e-7);
    EXPECT_NEAR(at.acceleration.z(), of.w_t + v.x() * of.w_x + v.z() * of.w_z, 1e-7);
  }
}

/// On the surface D(eta - z)/Dt = 0 and Bernoulli's constant, to the order of the theory: halving the height leaves an eighth.
TEST(waves, stokes_meets_the_kinematic_condition_of_the_surface_to_third_order) {
  const auto fault = [](Real height) {
    const PlaneWave wave = wave_of(WaveTheory::stokes2, height, 6, 5);
    Real most = 0;
    for (Real x = 0; x < 30; x += 0.5) {
      constexpr Real d = 1e-4;
      const Real eta = wave.elevation({x, 0, 0}, 0);
      const Real slope = (wave.elevation({x + d, 0, 0}, 0) - wave.elevation({x - d, 0, 0}, 0)) / (2 * d);
      const Real rises = (wave.elevation({x, 0, 0}, d) - wave.elevation({x, 0, 0}, -d)) / (2 * d);
      const Vector3 v = wave.at({x, 0, 0}, eta, 0).velocity;
      most = std::max(most, std::abs(rises + v.x() * slope - v.z()));
    }
    return most;
  };
  EXPECT_NEAR(fault(0.2) / fault(0.1), 8, 0.5);
}

TEST(waves, airy_accelerates_as_its_velocity_changes) {
  const PlaneWave wave = wave_of(WaveTheory::airy, 1e-6, 6, 5);  // so low that stretching changes nothing
  const Gradients of = gradients(wave, 2, -2, 0.4);
  const WaterMotion at = wave.at({2, 0, 0}, -2, 0.4);
  EXPECT_NEAR(at.acceleration.x(), of.u_t, 1e-12);
  EXPECT_NEAR(at.acceleration.z(), of.w_t, 1e-12);
}

TEST(waves, deep_water_has_no_numbers_that_are_none) {
  for (const WaveTheory theory : {WaveTheory::airy, WaveTheory::stokes2}) {
    const PlaneWave wave = wave_of(theory, 1, 2, 4000);
    EXPECT_NEAR(wave.at({0, 0, 0}, -4000, 0).velocity.norm(), 0, 1e-300);
    const Real stretched = theory == WaveTheory::airy ? 0.5 : 0;  // by the crest; the depth is as good as infinite
    EXPECT_NEAR(wave.at({0, 0, 0}, -1, 0).velocity.x() / (pi / 2 * std::exp(-wave.number() * (1 + stretched))), 1, 1e-3);
  }
}

TEST(waves, a_solitary_wave_carries_the_water_of_its_elevation) {
  const PlaneWave wave({.theory = WaveTheory::solitary, .height = 0.6, .depth = 2, .gravity = g});
  const Real c = std::sqrt(g * 2.6);
  for (const Real x : {-3.0, -0.4, 0.0, 2.0}) {
    const Real eta = wave.elevation({x, 0, 0}, 0), u = wave.at({x, 0, 0}, -1, 0).velocity.x();
    EXPECT_NEAR(u * (2 + eta), c * eta, 1e-12);  // flow through a section
    const Gradients of = gradients(wave, x, -0.5, 0);
    EXPECT_NEAR(of.u_x + of.w_z, 0, 1e-7);
    const WaterMotion at = wave.at({x, 0, 0}, -0.5, 0);
    const Vector3& v = at.velocity;
    EXPECT_NEAR(at.acceleration.x(), of.u_t + v.x() * of.u_x + v.z() * of.u_z, 1e-6);
    EXPECT_NEAR(at.acceleration.z(), of.w_t + v.x() * of.w_x + v.z() * of.w_z, 1e-6);
  }
  EXPECT_NEAR(wave.elevation({0, 0, 0}, 0), 0.6, 1e-15);
}

TEST(waves, a_record_is_linear_between_its_samples_and_stays_after_its_end) {
  const WaterRecord record{{0, 1, 3}, {0, 2, 1}, {0, 4, 0}};
  EXPECT_DOUBLE_EQ(sample(record, 0.5).elevation, 1);
  EXPECT_DOUBLE_EQ(sample(record, 2).velocity, 2);
  EXPECT_DOUBLE_EQ(sample(record, 2).acceleration, -2);
  EXPECT_DOUBLE_EQ(sample(record, 7).elevation, 1);
  EXPECT_DOUBLE_EQ(sample(record, -1).elevation, 0);
}

WaterField still() {
  WaterField water;
  water.gravity = g;
  return water;
}
BodyInWater ball(Real radius) { return {.radius = radius, .volume = 4 * pi / 3 * radius * radius * radius, .area = pi * radius * radius}; }

TEST(body_in_water, the_cap_below_the_surface_is_displaced) {
  const Real r = 0.3;
  for (const Real z : {-1.0, -0.25, 0.0, 0.1, 0.29, 0.4}) {
    const Real h = std::clamp(r - z, 0.0, 2 * r), cap = pi * h * h * (r - h / 3);
    EXPECT_NEAR(water_load(ball(r), {0, 0, z}, Vector3::Zero(), still(), 0).force.z(), 1000 * g * cap, 1e-9) << z;
  }
}

TEST(body_in_water, slow_spheres_are_dragged_as_stokes_says) {
  const Real r = 1e-5, v = 1e-6;
  const WaterLoad load = water_load(ball(r), {0, 0, -1}, {v, 0, 0}, still(), 0);
  EXPECT_NEAR(load.force.x() / (-6 * pi * 1e-3 * r * v), 1, 1e-3);
}

TEST(body_in_water, drag_opposes_the_relative_velocity_and_grows_with_its_square) {
  WaterField water = still();
  water.current = {2, 0, 0};
  BodyInWater body = ball(0.5);
  body.drag_coefficient = 0.7;
  const Vector3 force = water_load(body, {0, 0, -3}, {-1, 0, 0}, water, 0).force;
  EXPECT_NEAR(force.x(), 0.5 * 1000 * 0.7 * pi * 0.25 * 9, 1e-9);
  EXPECT_NEAR(force.y(), 0, 1e-12);
}

TEST(body_in_water, fast_spheres_have_the_drag_of_newtons_range) {
  const Real r = 0.1, v = 2;
  EXPECT_NEAR(water_load(ball(r), {0, 0, -1}, {v, 0, 0}, still(), 0).force.x(), -0.5 * 1000 * 0.44 * pi * r * r * v * v, 1e-9);
}

TEST(body_in_water, inertia_is_that_of_morison) {
  WaterField water = still();
  water.bed = -10;
  water.wave.emplace(PlaneWave::Given{.theory = WaveTheory::airy, .height = 0.5, .period = 6, .depth = 10, .gravity = g});
  BodyInWater body = ball(0.2);
  body.drag_coefficient = 0;
  body.inertia_coefficient = 2;
  const Vector3 at{1, 0, -3};
  const WaterLoad load = water_load(body, at, Vector3::Zero(), water, 0.8);
  const WaterMotion motion = water.motion(at, water.surface(at, 0.8), 0.8);
  EXPECT_NEAR(load.force.x(), 2 * 1000 * body.volume * motion.acceleration.x(), 1e-9);
  EXPECT_NEAR(load.added_mass, 1000 * body.volume, 1e-9);
}

/// The same water with gravity along another axis pushes the same way.
TEST(body_in_water, turns_with_gravity) {
  const auto load_in = [](const Matrix3& frame) {  // columns: along the waves, across them, up
    WaterField water = still();
    water.bed = -10;
    water.up = frame.col(2);
    water.towards = frame.col(0);
    water.wave.emplace(PlaneWave::Given{.theory = WaveTheory::stokes2,
                                        .height = 0.5,
                                        .period = 6,
                                        .depth = 10,
                                        .towards = frame.col(0),
                                        .up = frame.col(2),
                                        .gravity = g});
    const Vector3 force = water_load(ball(0.3), frame * Vector3(1, 2, -0.1), frame * Vector3(0.2, -0.1, 0.3), water, 0.8).force;
    return Vector3(frame.transpose() * force);
  };
  Matrix3 upright = Matrix3::Identity(), leaning = Eigen::AngleAxis<Real>(1.1, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_LT((load_in(upright) - load_in(leaning)).norm(), 1e-10 * load_in(upright).norm());
}

TEST(body_in_water, above_the_surface_nothing_acts) {
  const WaterLoad load = water_load(ball(0.2), {0, 0, 0.21}, {3, 2, 1}, still(), 0);
  EXPECT_EQ(load.force.norm(), 0);
  EXPECT_EQ(load.added_mass, 0);
}

}  // namespace
}  // namespace sazare::laws
