/// Joints in which opening and slip use up one strength: energies of pure and mixed modes, strength, friction that remains, and paths.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sazare/laws/joint_laws.hpp"

namespace sazare::laws {
namespace {

struct Numbers {
  Real normal_stiffness = 450e9, shear_stiffness = 180e9, tensile_strength = 6e6, fracture_energy = 120, cohesion = 18e6,
       friction_coefficient = 0.8;
};

constexpr Real shear_energy = 1500, residual_friction = 0.5;
const std::array<std::optional<Real>, 2> own{shear_energy, residual_friction};
const Numbers numbers;
const auto tension = MixedMode::tension(numbers, own);
const auto shear = MixedMode::shear(numbers, own);

/// A vertex that is led along a path of opening and sliding; sums per unit of area.
struct Vertex {
  Real opening = 0, peak = elastic_peak(tension), path = 0;
  Real elastic[2] = {0, 0}, slip[2] = {0, 0};
  Real normal_stress = 0;
  Real work_normal = 0, work_shear = 0;  ///< by the trapezium rule along the path [J/m2]
  Real by_opening = 0, by_slip = 0, friction = 0;

  Real damaged() const { return damage(tension, shear, peak, path); }
  Real shear_stress() const { return shear.stiffness * std::hypot(elastic[0], elastic[1]); }
  Real stored() const {
    return stored_energy(tension, opening, normal_stress) + 0.5 * shear_stress() * shear_stress() / shear.stiffness;
  }
  Real dissipated() const { return by_opening + by_slip + friction; }
  Real work() const { return work_normal + work_shear; }

  void move(Real open, Real x, Real y) {
    const Real normal_before = normal_stress, before[2] = {elastic[0], elastic[1]};
    opening += open;
    const Real old_peak = peak, old_damage = damaged();
    peak = std::max(peak, opening);
    by_opening += opening_dissipation(tension, old_peak, peak, old_damage);
    normal_stress = damaged_stress(tension, opening, peak, damaged());
    const Real stored_before = stored_energy(tension, opening, normal_stress);
    SofteningSlip<Real> at{{{elastic[0] + x, elastic[1] + y}, {}, {}}, {}};
    slip_and_soften(shear, at, normal_stress, damaged(), path);
    normal_stress = damaged_stress(tension, opening, peak, damaged());
    by_opening += stored_before - stored_energy(tension, opening, normal_stress);
    by_slip += at.fracture;
    friction += at.dissipation - at.fracture;
    for (int axis = 0; axis < 2; ++axis) {
      elastic[axis] = at.elastic[axis];
      slip[axis] += at.memory[axis];
    }
    work_normal += 0.5 * (normal_before + normal_stress) * open;
    work_shear += 0.5 * shear.stiffness * ((before[0] + elastic[0]) * x + (before[1] + elastic[1]) * y);
  }
};

TEST(joint_mixed_mode, pure_opening_is_linear_softening) {
  Vertex vertex;
  const auto linear = LinearSoftening::tension(numbers, {});
  for (int step = 0; step < 2000; ++step) {
    vertex.move(linear.failure_opening / 1999, 0, 0);
    EXPECT_NEAR(vertex.normal_stress, softened_stress(linear, vertex.opening, std::max(vertex.opening, elastic_peak(linear))),
                1e-9 * numbers.tensile_strength);
  }
  EXPECT_EQ(vertex.damaged(), 1);
  EXPECT_NEAR(vertex.by_opening, numbers.fracture_energy, 1e-9 * numbers.fracture_energy);
  EXPECT_NEAR(vertex.work(), numbers.fracture_energy, 1e-5 * numbers.fracture_energy);
}

TEST(joint_mixed_mode, pure_shear_dissipates_its_own_fracture_energy) {
  Vertex vertex;
  const Real last = 1.2 * shear.failure_slip;
  Real largest = 0;
  for (int step = 0; step < 4000; ++step) {
    vertex.move(0, 0.6 * last / 4000, 0.8 * last / 4000);
    largest = std::max(largest, vertex.shear_stress());
  }
  EXPECT_NEAR(largest, numbers.cohesion, 1e-3 * numbers.cohesion);
  EXPECT_EQ(vertex.shear_stress(), 0);
  EXPECT_NEAR(vertex.by_slip, shear_energy, 1e-9 * shear_energy);
  EXPECT_NEAR(vertex.work(), shear_energy, 1e-5 * shear_energy);
  EXPECT_NEAR(vertex.slip[0], 0.6 * last, 1e-9 * last);
}

/// Under pressure the strength begins at c + m_p p and ends at m_r p; the friction dissipated beside G_II is the area below.
TEST(joint_mixed_mode, under_pressure_friction_remains) {
  constexpr Real pressure = 10e6;
  Vertex vertex;
  vertex.move(-pressure / numbers.normal_stiffness, 0, 0);
  Real largest = 0;
  for (int step = 0; step < 8000; ++step) {
    vertex.move(0, 1.5 * shear.failure_slip / 8000, 0);
    largest = std::max(largest, vertex.shear_stress());
  }
  EXPECT_NEAR(vertex.normal_stress, -pressure, 1e-9 * pressure);
  EXPECT_NEAR(largest, numbers.cohesion + numbers.friction_coefficient * pressure, 1e-3 * largest);
  EXPECT_NEAR(vertex.shear_stress(), residual_friction * pressure, 1e-9 * pressure);
  EXPECT_NEAR(vertex.by_slip, shear_energy, 1e-9 * shear_energy);
  const Real falling = 0.5 * (numbers.friction_coefficient - residual_friction) * pressure * shear.failure_slip;
  EXPECT_NEAR(vertex.friction, falling + residual_friction * pressure * vertex.slip[0], 1e-6 * vertex.friction);
}

/// With almost rigid springs the joint fails where the two ratios of energy add up to 1, in whatever proportion it opens and slips.
TEST(joint_mixed_mode, fails_at_the_linear_criterion_of_energies) {
  Numbers stiff = numbers;
  stiff.normal_stiffness *= 1e4;
  stiff.shear_stiffness *= 1e4;
  stiff.friction_coefficient = 0;
  const std::array<std::optional<Real>, 2> without_friction{shear_energy, 0.0};
  const auto normal = MixedMode::tension(stiff, without_friction);
  const auto along = MixedMode::shear(stiff, without_friction);
  for (const Real share : {0.2, 0.5, 0.8}) {
    Real opening = 0, peak = elastic_peak(normal), path = 0, by_opening = 0, by_slip = 0, elastic = 0;
    constexpr int steps = 20000;
    for (int step = 0; step < steps && damage(normal, along, peak, path) < 1; ++step) {
      opening += 1.001 * share * normal.failure_opening / steps;
      const Real old_peak = peak, old_damage = damage(normal, along, peak, path);
      peak = std::max(peak, opening);
      by_opening += opening_dissipation(normal, old_peak, peak, old_damage);
      const Real stress = damaged_stress(normal, opening, peak, damage(normal, along, peak, path));
      SofteningSlip<Real> at{{{elastic + 1.001 * (1 - share) * along.failure_slip / steps, 0}, {}, {}}, {}};
      slip_and_soften(along, at, stress, damage(normal, along, peak, path), path);
      elastic = at.elastic[0];
      by_opening += 0.5 * opening * (stress - damaged_stress(normal, opening, peak, damage(normal, along, peak, path)));
      by_slip += at.fracture;
    }
    EXPECT_EQ(damage(normal, along, peak, path), 1) << share;
    EXPECT_NEAR(by_opening / numbers.fracture_energy + by_slip / shear_energy, 1, 2e-3) << share;
    EXPECT_NEAR(by_opening / numbers.fracture_energy, share, 2e-3) << share;
  }
}

TEST(joint_mixed_mode, without_damage_it_slips_as_linear_softening_does) {
  const Numbers frictional{.cohesion = 1e6, .friction_coefficient = 0.6};
  const std::array<std::optional<Real>, 2> tough{1e12, std::nullopt};
  const auto plain = LinearSoftening::shear(frictional, {});
  const auto along = MixedMode::shear(frictional, tough);
  Slip<Real> one{{3e-5, -4e-5}, {}, {}};
  SofteningSlip<Real> other{{{3e-5, -4e-5}, {}, {}}, {}};
  Real path = 0;
  slip_back(plain, one, shear_strength(plain, -2e6));
  slip_and_soften(along, other, Real{-2e6}, Real{0}, path);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(other.elastic[axis], one.elastic[axis], 1e-9 * 5e-5);
    EXPECT_NEAR(other.memory[axis], one.memory[axis], 1e-9 * 5e-5);
  }
  EXPECT_NEAR(path, std::hypot(one.memory[0], one.memory[1]), 1e-9 * 5e-5);
}

/// Whatever it is led through, a vertex dissipates in every step, and what was done to it is stored or dissipated.
TEST(joint_mixed_mode, any_path_dissipates_and_balances) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> number(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    Vertex vertex;
    Real work_scale = 0, mean[3] = {number(random), number(random), number(random)};
    for (int leg = 0; leg < 12; ++leg) {
      const Real to[3] = {1.2e-5 * number(random), 4e-5 * number(random), 4e-5 * number(random)};
      constexpr int steps = 2000;
      for (int step = 0; step < steps; ++step) {
        const Real before = vertex.dissipated();
        vertex.move((to[0] + 2e-6 * mean[0]) / steps, (to[1] + 1e-5 * mean[1]) / steps, (to[2] + 1e-5 * mean[2]) / steps);
        ASSERT_GE(vertex.dissipated(), before - 1e-12 * std::abs(before)) << trial << " " << leg << " " << step;
        ASSERT_LE(vertex.by_slip, shear_energy * (1 + 1e-9));
        work_scale = std::max(work_scale, std::abs(vertex.work()));
      }
    }
    EXPECT_NEAR(vertex.work(), vertex.stored() + vertex.dissipated(), 2e-3 * work_scale) << trial;
  }
}

/// Back where it began, a vertex has given back less than it was given.
TEST(joint_mixed_mode, a_closed_cycle_never_gains) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> number(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    Vertex vertex;
    Real at[3] = {0, 0, 0};
    for (int leg = 0; leg < 6; ++leg) {
      const bool last = leg == 5;
      const Real to[3] = {last ? 0 : 2e-5 * number(random), last ? 0 : 1e-4 * number(random), last ? 0 : 1e-4 * number(random)};
      for (int step = 0; step < 500; ++step) vertex.move((to[0] - at[0]) / 500, (to[1] - at[1]) / 500, (to[2] - at[2]) / 500);
      std::copy(std::begin(to), std::end(to), std::begin(at));
    }
    EXPECT_GT(vertex.work() - vertex.stored(), -1e-9 * shear_energy) << trial;
  }
}

/// Where the strength falls faster than the spring unloads, the stress falls to the residual strength at once.
TEST(joint_mixed_mode, under_high_pressure_it_is_brittle) {
  constexpr Real pressure = 400e6;
  Numbers weak = numbers;
  weak.shear_stiffness = 2e12 / 3;
  const std::array<std::optional<Real>, 2> brittle{400.0, 0.1};
  const auto along = MixedMode::shear(weak, brittle);
  ASSERT_GT((along.cohesion + (along.friction - along.residual_friction) * pressure) / along.failure_slip, along.stiffness);
  const Real strength = shear_strength(along, -pressure, Real{0});
  SofteningSlip<Real> at{{{1.0001 * strength / along.stiffness, 0}, {}, {}}, {}};
  Real path = 0;
  slip_and_soften(along, at, -pressure, Real{0}, path);
  EXPECT_NEAR(at.elastic[0] * along.stiffness, 0.1 * pressure, 1e-9 * pressure);
  EXPECT_GT(at.dissipation, at.fracture);
}

}  // namespace
}  // namespace sazare::laws
