#include "sazare/laws/granular/jkr.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sazare/laws/granular_contact.hpp"

namespace sazare::laws {
namespace {

constexpr Real pi = std::numbers::pi, reduced_radius = 0.005;

/// From soft and sticky to hard.
struct Solid {
  Real youngs_modulus, surface_energy;

  ContactConstants<Real> constants(Real restitution = 1, const GrainFriction& friction = {}) const {
    const GrainElasticity elasticity{youngs_modulus, 0.3};
    return Jkr::constants({elasticity, elasticity, restitution, friction}, {surface_energy});
  }
  /// E.
  Real modulus() const { return youngs_modulus / (2 * (1 - 0.3 * 0.3)); }
};

const std::vector<Solid> solids = {{1e6, 0.05}, {1e8, 10}, {70e9, 0.3}};

Reduced<Real> radius() { return Reduced<Real>::of(0.007, 0.0175); }

Real width_at(const ContactConstants<Real>& law, Real overlap) { return Jkr::width(law, overlap, radius()); }
Real force_at(const ContactConstants<Real>& law, Real overlap) {
  return Jkr::force(law, width_at(law, overlap), overlap, radius());
}
Real energy_at(const ContactConstants<Real>& law, Real overlap) {
  return Jkr::energy(law, Real{}, width_at(law, overlap), overlap, radius());
}

/// Across the neck and pressed, both up to far beyond the overlap of rest.
std::vector<Real> overlaps(Real neck) {
  std::vector<Real> all;
  for (int n = 1; n < 100; ++n) all.push_back(-0.01 * n * neck);
  for (int n = -20; n < 40; ++n) all.push_back(std::pow(10, 0.1 * n) * neck);
  return all;
}

TEST(jkr, overlap_and_force_follow_from_the_width_as_johnson_kendall_and_roberts_have_them) {
  for (const Solid& solid : solids) {
    const auto law = solid.constants();
    const Real w = solid.surface_energy, modulus = solid.modulus(), neck = Jkr::neck(law, reduced_radius);
    for (const Real overlap : overlaps(neck)) {
      const Real a = width_at(law, overlap);
      EXPECT_NEAR(a * a / reduced_radius - std::sqrt(2 * pi * w * a / modulus), overlap, 1e-12 * (neck + overlap));
      const Real pushes = 4 * modulus * a * a * a / (3 * reduced_radius), pulls = std::sqrt(8 * pi * w * modulus * a * a * a);
      EXPECT_NEAR(force_at(law, overlap), pushes - pulls, 1e-12 * (pushes + pulls));
    }
  }
}

TEST(jkr, force_is_the_slope_of_the_energy_when_pressed_and_across_the_neck) {
  for (const Solid& solid : solids) {
    const auto law = solid.constants();
    const Real neck = Jkr::neck(law, reduced_radius), pull_off = 1.5 * pi * solid.surface_energy * reduced_radius;
    for (const Real overlap : overlaps(neck)) {
      const Real small = 1e-4 * std::max(overlap, 0.1 * neck);
      const Real slope = (energy_at(law, overlap + small) - energy_at(law, overlap - small)) / (2 * small);
      EXPECT_NEAR(force_at(law, overlap), slope, 1e-6 * (std::abs(slope) + pull_off)) << overlap / neck;
    }
    EXPECT_NEAR(energy_at(law, 0), 0, 1e-14 * Jkr::parting_loss(law, reduced_radius));
  }
}

/// The least force from d = 0 to where the neck breaks.
TEST(jkr, slow_pulling_meets_the_exact_pull_off_force) {
  for (const Solid& solid : solids) {
    const auto law = solid.constants();
    const Real neck = Jkr::neck(law, reduced_radius), exact = 1.5 * pi * solid.surface_energy * reduced_radius;
    Real least = 0;
    constexpr int steps = 200000;
    for (int n = 0; n < steps; ++n) least = std::min(least, force_at(law, -neck * n / steps));
    EXPECT_NEAR(-least, exact, 1e-9 * exact);
    EXPECT_NEAR(-force_at(law, 0), 8.0 / 9 * exact, 1e-12 * exact);
    EXPECT_NEAR(-force_at(law, -neck * (1 - 1e-14)), 5.0 / 9 * exact, 1e-6 * exact);
  }
}

TEST(jkr, a_neck_holds_up_to_its_length) {
  for (const Solid& solid : solids) {
    const auto law = solid.constants();
    const Real neck = Jkr::neck(law, reduced_radius), ratio = pi * solid.surface_energy / solid.modulus(),
               exact = 0.75 * std::cbrt(ratio * ratio * reduced_radius);
    EXPECT_NEAR(neck, exact, 1e-14 * exact);
    EXPECT_TRUE(Jkr::holds(law, Real{1e-9}, radius()));
    EXPECT_TRUE(Jkr::holds(law, Real{-neck * (1 - 1e-12)}, radius()));
    EXPECT_FALSE(Jkr::holds(law, Real{-neck * (1 + 1e-12)}, radius()));
  }
}

/// The work of pulling from d = 0 to where the neck breaks, by Simpson's rule, is dissipated: 7.09 (w^5 R^4/E^2)^(1/3).
TEST(jkr, a_slow_cycle_dissipates_the_work_of_thornton_and_ning) {
  for (const Solid& solid : solids) {
    const auto law = solid.constants();
    const Real neck = Jkr::neck(law, reduced_radius), loss = Jkr::parting_loss(law, reduced_radius);
    // The force has a root where the neck breaks: with d = -neck (1 - s^2) it is smooth in s.
    constexpr int steps = 2000;
    const auto slope = [&](int n) {
      const Real s = static_cast<Real>(n) / steps;
      return -force_at(law, -neck * (1 - s * s)) * 2 * s * neck;
    };
    Real work = 0;
    for (int n = 0; n < steps; n += 2) work += (slope(n) + 4 * slope(n + 1) + slope(n + 2)) / (3 * steps);
    EXPECT_NEAR(work, loss, 1e-8 * loss);
    EXPECT_NEAR(energy_at(law, -neck), loss, 1e-7 * loss);
    const Real w = solid.surface_energy, modulus = solid.modulus();
    EXPECT_NEAR(loss, 7.09 * std::cbrt(std::pow(w, 5) * std::pow(reduced_radius, 4) / (modulus * modulus)), 1e-3 * loss);
  }
}

TEST(jkr, without_adhesion_is_hertz) {
  const Solid solid{1e8, 0};
  const auto law = solid.constants(0.7, {0.4, 0.1, 0.05});
  EXPECT_EQ(Jkr::neck(law, reduced_radius), 0);
  EXPECT_EQ(Jkr::parting_loss(law, reduced_radius), 0);
  EXPECT_FALSE(Jkr::holds(law, Real{0}, radius()));
  for (const Real overlap : {1e-30, 1e-12, 1e-6, 1e-3}) {
    ContactMotion<Real> at{};
    at.overlap = overlap;
    at.radius = radius();
    at.mass = Reduced<Real>::alone(0.01);
    at.normal = {0, 0, 1};
    at.velocity = {0.3, 0, -0.1};
    at.rolling = {0, 0.2, 0};
    at.twisting = 0.1;
    at.step = 1e-6;
    ContactMemory<Real> memory{}, other_memory{};
    const auto force = contact_force<Jkr, true>(law, at, memory), hertz = contact_force<Hertz, true>(law, at, other_memory);
    const auto expect_equal = [](Real one, Real other) { EXPECT_NEAR(one, other, 1e-14 * std::abs(other)); };
    expect_equal(force.normal, hertz.normal);
    expect_equal(force.friction[0], hertz.friction[0]);
    expect_equal(force.rolling[1], hertz.rolling[1]);
    expect_equal(force.twisting, hertz.twisting);
    expect_equal(force.elastic_energy, hertz.elastic_energy);
    expect_equal(force.dashpot_power, hertz.dashpot_power);
  }
}

TEST(jkr, spheres_that_only_stick_together_resist_sliding) {
  const Solid solid{1e8, 10};
  const auto law = solid.constants(1, {0.4});
  const Real pull_off = 1.5 * pi * solid.surface_energy * reduced_radius;
  ContactMotion<Real> at{};
  at.overlap = -0.3 * Jkr::neck(law, reduced_radius);
  at.radius = radius();
  at.mass = Reduced<Real>::alone(0.01);
  at.normal = {0, 0, 1};
  at.velocity = {1, 0, 0};
  at.step = 1e-6;
  ContactMemory<Real> memory{};
  ContactForce<Real> force{};
  for (int step = 0; step < 100; ++step) force = contact_force<Jkr, false>(law, at, memory);
  EXPECT_LT(force.normal, -0.9 * pull_off);
  EXPECT_NEAR(-force.friction[0], 0.4 * (force.normal + 2 * pull_off), 1e-12 * pull_off);
}

TEST(jkr, finds_the_overlap_that_holds_an_energy) {
  for (const Solid& solid : solids) {
    const auto law = solid.constants();
    for (const Real share : {1e-3, 1.0, 1e3}) {
      const Real energy = share * Jkr::parting_loss(law, reduced_radius);
      const Real overlap = overlap_of_energy(ContactModel::jkr, law, energy, reduced_radius);
      EXPECT_GT(force_at(law, overlap), 0);
      EXPECT_NEAR(normal_energy(ContactModel::jkr, law, overlap, reduced_radius), energy, 1e-11 * (1 + 1 / share) * energy);
    }
  }
}

template <class Number>
Number width_of(const ContactConstants<Real>& one, Number overlap) {
  ContactConstants<Number> law;
  law.normal = Number{} + one.normal;
  law.adhesion = Number{} + one.adhesion;
  return Jkr::width(law, overlap, Reduced<Number>::alone(Number{} + reduced_radius));
}

/// What stands in the other lanes, be it pressed, stretched or no contact at all, changes no bit.
TEST(jkr, a_lane_does_not_hang_on_the_others) {
  for (const Solid& solid : solids) {
    const auto law = solid.constants();
    const Real neck = Jkr::neck(law, reduced_radius);
    for (const Real overlap : {-0.9 * neck, -1e-3 * neck, 0.0, 0.5 * neck, 100 * neck}) {
      const Real alone = width_of(law, TwinLanes(overlap))[0], alone_in_one = width_of(law, broadcast(overlap))[0];
      EXPECT_NEAR(alone, width_at(law, overlap), 1e-13 * alone);
      for (const Real beside : {-0.99 * neck, 1e-30, 1e4 * neck}) {
        TwinLanes lanes(beside);
        for (int lane = 0; lane < TwinLanes::count; lane += 3) lanes.set(lane, overlap);
        const TwinLanes widths = width_of(law, lanes);
        for (int lane = 0; lane < TwinLanes::count; lane += 3) EXPECT_EQ(widths[lane], alone);
        EXPECT_EQ(width_of(law, lanes.first)[0], alone_in_one);
      }
    }
  }
}

TEST(cube_root, is_that_of_the_standard_library) {
  for (const Real value : {1e-280, 1e-30, 0.02, 1.0, 27.0, 3e40}) {
    EXPECT_NEAR(cube_root(value), std::cbrt(value), 4e-16 * std::cbrt(value));
    EXPECT_NEAR(cube_root(TwinLanes(value))[3], std::cbrt(value), 4e-16 * std::cbrt(value));
  }
  EXPECT_EQ(cube_root(Real{0}), 0);
}

}  // namespace
}  // namespace sazare::laws
