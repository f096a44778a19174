/// Natural rock joints by Barton and Bandis: closure from an energy, strength, mobilised roughness, dilation, and paths.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "sazare/laws/joint_laws.hpp"

namespace sazare::laws {
namespace {

struct Springs {
  Real normal_stiffness = 450e9, shear_stiffness = 180e9;
};

constexpr Real degree = std::numbers::pi / 180;

/// JRC 10, JCS 100 MPa, 30 deg, 0.1 m long, an aperture of 0.3 mm.
BartonBandis::Own usual() { return {10.0, 100e6, 30.0, 0.1, std::nullopt, 0.3e-3}; }

struct Law {
  explicit Law(const BartonBandis::Own& own)
      : closure(BartonBandis::tension(Springs{}, own)), rough(BartonBandis::shear(Springs{}, own)) {}
  JointClosure<Real> closure;
  RoughShear<Real> rough;
};

/// Worked by hand: K_ni = -7.15 + 17.5 + 0.02 x 333.3 = 17.017 MPa/mm, V_m = -0.296 - 0.056 + 2.241 x 333.3^-0.245 = 0.1879 mm.
TEST(joint_barton_bandis, stiffness_and_closure_follow_from_the_aperture) {
  EXPECT_NEAR(BartonBandis::initial_stiffness_of(usual()), 17.017e9, 1e6);
  EXPECT_NEAR(BartonBandis::closure_of(usual()), 0.1879e-3, 1e-7);
}

/// Without springs in series the closure is 1/(1/V_m + K_ni/s): 0.0448, 0.1424 and 0.1821 mm under 1, 10 and 100 MPa.
TEST(joint_barton_bandis, closes_along_the_hyperbola) {
  Law law(usual());
  set_stiffness(law.closure, 1e18);
  EXPECT_NEAR(compression_under(law.closure, 1e6), 0.0448e-3, 1e-7);
  EXPECT_NEAR(compression_under(law.closure, 10e6), 0.1424e-3, 1e-7);
  EXPECT_NEAR(compression_under(law.closure, 100e6), 0.1821e-3, 1e-7);
}

TEST(joint_barton_bandis, pressure_is_that_of_springs_and_joint_in_series) {
  const Law law(usual());
  EXPECT_EQ(closing_pressure(law.closure, Real{0}), 0);
  EXPECT_EQ(closing_pressure(law.closure, Real{-1e-4}), 0);
  for (Real pressure = 1; pressure < 1e10; pressure *= 3) {
    const Real compression = compression_under(law.closure, pressure);
    EXPECT_NEAR(closing_pressure(law.closure, compression), pressure, 1e-9 * pressure);
    const Lanes lanes = closing_pressure(law.closure, Lanes{} + compression);
    EXPECT_EQ(lanes[0], closing_pressure(law.closure, compression));
  }
  const Real first = closing_pressure(law.closure, Real{1e-12}) / 1e-12;
  EXPECT_NEAR(first, 1 / (1 / 450e9 + 1 / BartonBandis::initial_stiffness_of(usual())), 1e-6 * first);
}

/// So the stable step need not know of the joint.
TEST(joint_barton_bandis, is_never_stiffer_than_the_springs) {
  const Law law(usual());
  for (Real compression = 1e-7; compression < 1e-2; compression *= 1.3) {
    const Real by = 1e-4 * compression;
    const Real slope = (closing_pressure(law.closure, compression + by) - closing_pressure(law.closure, compression)) / by;
    EXPECT_LT(slope, 450e9 * (1 + 1e-9)) << compression;
  }
}

TEST(joint_barton_bandis, pressure_is_the_slope_of_the_energy) {
  const Law law(usual());
  for (Real compression = 1e-6; compression < 1e-3; compression *= 1.5) {
    const auto energy = [&](Real at) { return closing_energy(law.closure, closing_pressure(law.closure, at)); };
    const Real by = 1e-4 * compression, slope = (energy(compression + by) - energy(compression - by)) / (2 * by);
    EXPECT_NEAR(slope, closing_pressure(law.closure, compression), 1e-6 * slope) << compression;
    const Lanes in_lanes = closing_energy(law.closure, Lanes{} + closing_pressure(law.closure, compression));
    EXPECT_EQ(in_lanes[lane_count - 1], energy(compression));
  }
}

TEST(joint_barton_bandis, a_joint_that_does_not_close_is_a_spring) {
  auto own = usual();
  own[BartonBandis::joint_aperture] = std::nullopt;
  const Law law(own);
  for (const Real compression : {1e-9, 1e-6, 1e-3})
    EXPECT_NEAR(closing_pressure(law.closure, compression), 450e9 * compression, 1e-6 * 450e9 * compression + 1);
  EXPECT_NEAR(closing_energy(law.closure, Real{1e6}), 0.5 * 1e12 / 450e9, 1e-9);
}

/// tau = s tan(29 deg + 16.9 log10(96 MPa/s)), worked by hand; the first is where the angle reaches 70 deg.
TEST(joint_barton_bandis, strength_at_the_peak) {
  auto own = usual();
  own[BartonBandis::jrc] = 16.9;
  own[BartonBandis::jcs] = 96e6;
  own[BartonBandis::residual_friction_angle] = 29;
  const Law law(own);
  const std::array<std::array<Real, 2>, 8> rows{{{0.360, 0.989},
                                                 {0.720, 1.538},
                                                 {1.440, 2.477},
                                                 {2.880, 4.073},
                                                 {5.759, 6.779},
                                                 {11.518, 11.344},
                                                 {23.036, 18.973},
                                                 {46.073, 31.533}}};
  for (const auto& [pressure, strength] : rows)
    EXPECT_NEAR(rough_strength(law.rough, pressure * 1e6, 1), strength * 1e6, 0.6e3) << pressure;
}

TEST(joint_barton_bandis, under_small_pressure_the_friction_angle_is_at_most_70_degrees) {
  const Law law(usual());
  for (const Real pressure : {1e-3, 1.0, 1e3})
    EXPECT_NEAR(rough_strength(law.rough, pressure, 1), pressure * std::tan(70 * degree), 1e-9 * pressure);
  EXPECT_EQ(rough_strength(law.rough, 0, 1), 0);
}

TEST(joint_barton_bandis, beyond_the_strength_of_the_walls_only_residual_friction_is_left) {
  const Law law(usual());
  for (const Real pressure : {100e6, 300e6})
    EXPECT_NEAR(rough_strength(law.rough, pressure, 1), pressure * std::tan(30 * degree), 1e-9 * pressure);
}

TEST(joint_barton_bandis, roughness_is_mobilised_by_slip_and_worn) {
  for (const auto& [x, share] : {std::pair{0.0, 0.0},
                                 {0.3, 0.0},
                                 {0.45, 0.375},
                                 {0.6, 0.75},
                                 {1.0, 1.0},
                                 {1.5, 0.925},
                                 {2.0, 0.85},
                                 {4.0, 0.7},
                                 {10.0, 0.5},
                                 {55.0, 0.25},
                                 {100.0, 0.0},
                                 {1e6, 0.0}})
    EXPECT_NEAR(mobilised_roughness(x), share, 1e-12) << x;
}

/// L/500 (JRC/L)^(1/3) = 0.1/500 x 100^(1/3) = 0.928 mm.
TEST(joint_barton_bandis, the_peak_is_at_a_slip_by_length_and_roughness) {
  EXPECT_NEAR(Law(usual()).rough.peak_slip, 0.9283e-3, 1e-7);
}

/// From 0.1 to 1 m: JRC 10 x 10^-0.2 = 6.31, JCS 100 MPa x 10^-0.3 = 50.1 MPa; K_ni and V_m are of specimens and stay.
TEST(joint_barton_bandis, longer_joints_are_smoother_and_weaker) {
  auto own = usual();
  own[BartonBandis::joint_length] = 1;
  own[BartonBandis::laboratory_length] = 0.1;
  EXPECT_NEAR(BartonBandis::roughness_of(own), 6.3096, 1e-4);
  EXPECT_NEAR(BartonBandis::wall_strength_of(own), 50.119e6, 1e3);
  EXPECT_NEAR(Law(own).rough.peak_slip, 1.0 / 500 * std::cbrt(6.3096), 1e-7);
  EXPECT_EQ(Law(own).closure.most, Law(usual()).closure.most);
}

/// A vertex that is led along a path of opening and sliding; sums per unit of area.
struct Vertex {
  explicit Vertex(const BartonBandis::Own& own) : law(own) {}

  Law law;
  Real opening = 0, dilation = 0, path = 0;
  Real elastic[2] = {0, 0}, slip[2] = {0, 0};
  Real work = 0, dissipated = 0;  ///< work by the trapezium rule [J/m2]

  Real pressure() const { return closing_pressure(law.closure, dilation - opening); }
  Real shear_stress() const { return law.rough.stiffness * std::hypot(elastic[0], elastic[1]); }
  Real stored() const {
    return closing_energy(law.closure, pressure()) + 0.5 * shear_stress() * shear_stress() / law.rough.stiffness;
  }

  void move(Real open, Real x, Real y) {
    const Real pressure_before = pressure(), before[2] = {elastic[0], elastic[1]};
    opening += open;
    RoughVertex at{.elastic = {elastic[0] + x, elastic[1] + y},
                   .compression = dilation - opening,
                   .path = path,
                   .shear_before = {law.rough.stiffness * before[0], law.rough.stiffness * before[1]},
                   .pressure_before = pressure_before};
    slide(law.closure, law.rough, at);
    for (int axis = 0; axis < 2; ++axis) {
      elastic[axis] = at.elastic[axis];
      slip[axis] += at.slip[axis];
    }
    path = at.path;
    dilation += at.dilation;
    dissipated += at.dissipation;
    work -= 0.5 * (pressure_before + pressure()) * open;
    work += 0.5 * law.rough.stiffness * ((before[0] + elastic[0]) * x + (before[1] + elastic[1]) * y);
  }

  /// Slides under a constant pressure.
  void slide_under(Real constant, Real x) { move(dilation - compression_under(law.closure, constant) - opening, x, 0); }
};

TEST(joint_barton_bandis, a_plane_joint_slips_by_its_residual_friction_without_dilation) {
  auto own = usual();
  own[BartonBandis::jrc] = 0;
  own[BartonBandis::joint_aperture] = std::nullopt;
  Vertex vertex(own);
  for (int step = 0; step < 100; ++step) {
    vertex.slide_under(5e6, 1e-6);
    EXPECT_LT(vertex.shear_stress(), 5e6 * std::tan(30 * degree) * (1 + 1e-9));
  }
  EXPECT_NEAR(vertex.shear_stress(), 5e6 * std::tan(30 * degree), 1e-3);
  EXPECT_EQ(vertex.dilation, 0);
  EXPECT_NEAR(vertex.dissipated, vertex.work - vertex.stored(), 1e-9 * vertex.dissipated);
}

/// The peak is there at the peak slip, and the joint has dilated by the integral of tan(i/M).
TEST(joint_barton_bandis, direct_shear_under_constant_pressure) {
  for (const Real pressure : {0.5e6, 2e6, 10e6}) {
    Vertex vertex(usual());
    const Real peak_slip = vertex.law.rough.peak_slip, full = 10 * std::log10(100e6 / pressure) * degree;
    const Real closed = compression_under(vertex.law.closure, pressure);
    for (int step = 0; step < 2000; ++step) vertex.move(-closed / 2000, 0, 0);
    Real largest = 0, slip_there = 0, expected = 0;
    for (int step = 0; step < 20000; ++step) {
      const Real before = vertex.path;
      vertex.slide_under(pressure, 3 * peak_slip / 20000);
      expected += std::tan(0.5 * mobilised_roughness(0.5 * (before + vertex.path) / peak_slip) * full) * (vertex.path - before);
      if (vertex.shear_stress() > largest) {
        largest = vertex.shear_stress();
        slip_there = vertex.path;
      }
    }
    EXPECT_NEAR(largest, pressure * std::tan(30 * degree + full), 2e-3 * largest) << pressure;
    EXPECT_NEAR(slip_there, peak_slip, 2e-3 * peak_slip) << pressure;
    EXPECT_NEAR(vertex.dilation, expected, 2e-3 * expected) << pressure;
    EXPECT_NEAR(vertex.work, vertex.stored() + vertex.dissipated, 1e-6 * vertex.work) << pressure;
  }
}

/// Held apart at a constant distance, dilation raises pressure and strength.
TEST(joint_barton_bandis, dilation_that_is_held_raises_the_pressure) {
  Vertex vertex(usual());
  vertex.move(-compression_under(vertex.law.closure, 1e6), 0, 0);
  for (int step = 0; step < 2000; ++step) vertex.move(0, vertex.law.rough.peak_slip / 1000, 0);
  EXPECT_GT(vertex.pressure(), 10e6);
  EXPECT_GT(vertex.shear_stress(), 10e6);
}

TEST(joint_barton_bandis, an_open_joint_bears_nothing_and_does_not_wear) {
  Vertex vertex(usual());
  vertex.move(1e-4, 0, 0);
  vertex.move(0, 3e-3, 1e-3);
  EXPECT_EQ(vertex.pressure(), 0);
  EXPECT_EQ(vertex.shear_stress(), 0);
  EXPECT_EQ(vertex.path, 0);
  vertex.move(-1e-4 - compression_under(vertex.law.closure, 1e6), 0, 0);
  EXPECT_NEAR(vertex.pressure(), 1e6, 1e-3);
}

/// One evaluation of a jump in place or of many small ones: with the stresses after it, none gives energy.
TEST(joint_barton_bandis, no_slip_gains_however_far_it_goes) {
  std::mt19937 random(2);
  std::uniform_real_distribution<Real> number(0, 1);
  const auto spread = [&](Real decades) { return std::pow(10, decades * (2 * number(random) - 1)); };
  for (int trial = 0; trial < 20000; ++trial) {
    const BartonBandis::Own own{20 * number(random), 10e6 * spread(1), 60 * number(random),   0.1 * spread(1),   std::nullopt,
                                std::nullopt,        1e10 * spread(1), 3e-4 * number(random), 1 + number(random)};
    const Law law(own);
    RoughVertex at{{1e-4 * spread(3), 1e-5 * spread(2)}, 1e-4 * spread(3), law.rough.peak_slip * spread(2)};
    const Real scale = law.rough.stiffness * (at.elastic[0] * at.elastic[0] + at.elastic[1] * at.elastic[1]);
    slide(law.closure, law.rough, at);
    const Real friction = law.rough.stiffness * (at.elastic[0] * at.slip[0] + at.elastic[1] * at.slip[1]);
    ASSERT_GE(friction - closing_pressure(law.closure, at.compression) * at.dilation, -1e-12 * scale) << trial;
  }
}

/// However the dashpot pulls, both together are within the circle of the strength, and the dashpot is whole where it fits.
TEST(joint_barton_bandis, friction_bounds_spring_and_dashpot_together) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> number(-1, 1);
  int whole = 0, none = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Real strength = trial % 5 == 0 ? 0 : std::abs(number(random)), angle = std::numbers::pi * number(random);
    const Real borne = trial % 3 == 0 ? strength : strength * std::abs(number(random));
    const std::array<Real, 2> stress{borne * std::cos(angle), borne * std::sin(angle)}, dashpot{number(random), number(random)};
    const Real share = damping_share(stress, dashpot, strength);
    const auto length = [&](Real of) { return std::hypot(stress[0] + of * dashpot[0], stress[1] + of * dashpot[1]); };
    ASSERT_GE(share, 0) << trial;
    ASSERT_LE(share, 1) << trial;
    ASSERT_LE(length(share), strength + 1e-7) << trial;
    if (share < 1) {
      ASSERT_GE(length(std::min(share + 1e-3, Real{1})), strength - 1e-7) << trial << ": it might be more";
    }
    whole += share == 1;
    none += share == 0;
  }
  EXPECT_GT(whole, 1000);
  EXPECT_GT(none, 1000);
}

/// Back where it began, a vertex has given back less than it was given, in whatever order it is closed, opened and sheared.
TEST(joint_barton_bandis, a_closed_cycle_never_gains) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> number(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    auto own = usual();
    own[BartonBandis::damage] = trial % 2 == 0 ? 1 : 2;
    Vertex vertex(own);
    Real at[3] = {0, 0, 0};
    for (int leg = 0; leg < 8; ++leg) {
      const bool last = leg == 7;
      const Real to[3] = {last ? 0 : 3e-4 * (number(random) - 0.4), last ? 0 : 2e-3 * number(random),
                          last ? 0 : 2e-3 * number(random)};
      for (int step = 0; step < 2000; ++step) vertex.move((to[0] - at[0]) / 2000, (to[1] - at[1]) / 2000, (to[2] - at[2]) / 2000);
      std::copy(std::begin(to), std::end(to), std::begin(at));
    }
    EXPECT_GT(vertex.work - vertex.stored(), 0) << trial;
    EXPECT_NEAR(vertex.work, vertex.stored() + vertex.dissipated, 1e-4 * vertex.work) << trial;
  }
}

/// Closing and opening alone, or sliding within the friction, gives back all.
TEST(joint_barton_bandis, closing_and_opening_is_elastic) {
  Vertex vertex(usual());
  for (int step = 0; step < 1000; ++step) vertex.move(-3e-7, 0, 0);
  EXPECT_GT(vertex.work, 0);
  for (int step = 0; step < 1000; ++step) vertex.move(3e-7, 0, 0);
  EXPECT_NEAR(vertex.work, 0, 1e-9);
  EXPECT_EQ(vertex.dissipated, 0);
}

}  // namespace
}  // namespace sazare::laws
