#include "sazare/laws/sphere_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sazare::laws {
namespace {

SphereContact contact(DampingCap cap, Real damping = 3.08e6) { return {1.5e9, damping, 0.58, cap}; }

SphereMotion closing(Real speed) {
  SphereMotion at;
  at.overlap = 1e-6;
  at.opening_speed = -speed;
  at.normal_mass = 0.01;
  at.sliding_mass = 0.02;
  at.shared_step = 1e-7;
  return at;
}

TEST(sphere_contact, elastic_force_is_the_slope_of_the_energy) {
  const auto law = contact(DampingCap::step);
  for (const Real overlap : {1e-7, 1e-5, 1e-3}) {
    const Real step = 1e-3 * overlap;
    const Real slope = (sphere_energy(law, overlap + step) - sphere_energy(law, overlap - step)) / (2 * step);
    SphereMotion at = closing(0);
    at.overlap = overlap;
    EXPECT_NEAR(sphere_force(law, at).elastic, slope, 1e-10 * slope);
  }
}

TEST(sphere_contact, never_attracts) {
  for (const auto cap : {DampingCap::literal, DampingCap::critical, DampingCap::step})
    for (const Real speed : {-1e4, -1.0, -1e-3, 0.0, 1e-3, 1.0, 1e4}) {
      const SphereForce force = sphere_force(contact(cap), closing(speed));
      EXPECT_GE(force.elastic + force.dashpot, 0);
      EXPECT_GE(force.friction, 0);
    }
}

TEST(sphere_contact, dashpot_works_against_the_motion) {
  EXPECT_GT(sphere_force(contact(DampingCap::literal), closing(1)).dashpot, 0);
  EXPECT_LT(sphere_force(contact(DampingCap::literal), closing(-1e-4)).dashpot, 0);
}

TEST(sphere_contact, the_cap_of_the_step_takes_half_of_the_closing_speed_at_most) {
  const SphereMotion at = closing(2);
  const SphereForce force = sphere_force(contact(DampingCap::step), at);
  EXPECT_NEAR(force.dashpot * at.shared_step / at.normal_mass, 1.0, 1e-12);  // 3.08e6 h / m = 30.8: the cap binds
  const SphereForce soft = sphere_force(contact(DampingCap::step, 1.0), at);
  EXPECT_DOUBLE_EQ(soft.dashpot, 2.0);  // c v: it does not bind
}

TEST(sphere_contact, the_critical_cap_is_that_of_the_spring_and_the_mass) {
  const Real critical = 2 * std::sqrt(1.5e9 * 0.01);
  EXPECT_DOUBLE_EQ(capped_damping(contact(DampingCap::critical), closing(1)), critical);
  EXPECT_DOUBLE_EQ(capped_damping(contact(DampingCap::critical, 10), closing(1)), 10);
  EXPECT_DOUBLE_EQ(capped_damping(contact(DampingCap::literal), closing(1)), 3.08e6);
}

TEST(sphere_contact, friction_is_coulombs_while_it_does_not_reverse_the_sliding) {
  SphereMotion at = closing(0);
  at.sliding_speed = 100;  // m v / (2 h) = 1e7 N, far above mu N
  const SphereForce fast = sphere_force(contact(DampingCap::step), at);
  EXPECT_DOUBLE_EQ(fast.friction, 0.58 * fast.elastic);
  at.sliding_speed = 1e-6;
  const SphereForce slow = sphere_force(contact(DampingCap::step), at);
  EXPECT_NEAR(slow.friction * at.shared_step / at.sliding_mass, 0.5e-6, 1e-18);
  at.sliding_speed = 0;
  EXPECT_EQ(sphere_force(contact(DampingCap::step), at).friction, 0);
}

TEST(sphere_contact, friction_counts_the_dashpots_share_of_the_normal_force) {
  SphereMotion at = closing(1e-3);
  at.sliding_speed = 100;
  const SphereForce force = sphere_force(contact(DampingCap::literal), at);
  EXPECT_DOUBLE_EQ(force.friction, 0.58 * (1500.0 + 3080.0));
}

}  // namespace
}  // namespace sazare::laws
