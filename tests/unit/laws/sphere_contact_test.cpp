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
  at.step = at.elapsed = 1e-7;
  return at;
}

SphereForce first_force(const SphereContact& law, const SphereMotion& at) {
  SphereMemory memory;
  return sphere_force(law, at, memory);
}

TEST(sphere_contact, elastic_force_is_the_slope_of_the_energy) {
  const auto law = contact(DampingCap::step);
  for (const Real overlap : {1e-7, 1e-5, 1e-3}) {
    const Real step = 1e-3 * overlap;
    const Real slope = (sphere_energy(law, overlap + step) - sphere_energy(law, overlap - step)) / (2 * step);
    SphereMotion at = closing(0);
    at.overlap = overlap;
    EXPECT_NEAR(first_force(law, at).elastic, slope, 1e-10 * slope);
  }
}

TEST(sphere_contact, never_attracts_whatever_it_remembers) {
  for (const auto cap : {DampingCap::literal, DampingCap::critical, DampingCap::step}) {
    SphereMemory memory;
    for (const Real speed : {1.0, -1e4, -1.0, -1e-3, 0.0, 1e-3, 1.0, -2.0, 1e4, -1e4}) {
      const SphereForce force = sphere_force(contact(cap), closing(speed), memory);
      EXPECT_GE(force.elastic + force.dashpot, 0);
      EXPECT_LE(force.friction.norm(), (1 + 1e-14) * 0.58 * (force.elastic + force.dashpot));
    }
  }
}

TEST(sphere_contact, dashpot_works_against_the_motion) {
  EXPECT_GT(first_force(contact(DampingCap::literal), closing(1)).dashpot, 0);
  EXPECT_LT(first_force(contact(DampingCap::literal), closing(-1e-4)).dashpot, 0);
}

TEST(sphere_contact, a_dashpot_that_the_step_bears_is_taken_as_it_is) {
  EXPECT_DOUBLE_EQ(first_force(contact(DampingCap::step, 1.0), closing(2)).dashpot, 2.0);
  EXPECT_DOUBLE_EQ(first_force(contact(DampingCap::literal), closing(2)).dashpot, 2 * 3.08e6);
}

TEST(sphere_contact, a_stiffer_one_takes_a_part_of_the_closing_speed_in_a_step) {
  const SphereMotion at = closing(2);  // 3.08e6 h / m = 30.8: far beyond what a step bears
  const Real taken = first_force(contact(DampingCap::step), at).dashpot * at.step / at.normal_mass;
  EXPECT_NEAR(taken, 2.0 * (1.0 / 4 + 1.0 / 16), 2e-3);
}

TEST(sphere_contact, under_steady_closing_the_stiff_dashpot_becomes_itself) {
  // However long the step: what is built up tends to c v.
  for (const Real step : {1e-8, 1e-7, 1e-6}) {
    SphereMotion at = closing(0.5);
    at.step = at.elapsed = step;
    SphereMemory memory;
    SphereForce force;
    const Real time_to_build_up = 16 * 3.08e6 * step * step / at.normal_mass;
    for (Real time = 0; time < 40 * time_to_build_up; time += step) force = sphere_force(contact(DampingCap::step), at, memory);
    EXPECT_NEAR(force.dashpot, 0.5 * 3.08e6, 1e-3 * force.dashpot) << step;
  }
}

TEST(sphere_contact, the_critical_cap_is_that_of_the_spring_and_the_mass) {
  const Real critical = 2 * std::sqrt(1.5e9 * 0.01);
  EXPECT_DOUBLE_EQ(capped_damping(contact(DampingCap::critical), closing(1)), critical);
  EXPECT_DOUBLE_EQ(capped_damping(contact(DampingCap::critical, 10), closing(1)), 10);
  EXPECT_DOUBLE_EQ(capped_damping(contact(DampingCap::literal), closing(1)), 3.08e6);
  SphereMotion shared = closing(1);
  shared.contacts = 4;
  EXPECT_DOUBLE_EQ(capped_damping(contact(DampingCap::critical), shared), critical / 2);
}

TEST(sphere_contact, friction_is_coulombs_against_fast_sliding) {
  SphereMotion at = closing(0);
  at.sliding = {0, 60, 80};
  const SphereForce force = first_force(contact(DampingCap::step), at);
  EXPECT_LT((force.friction + 0.58 * force.elastic * Vector3(0, 0.6, 0.8)).norm(), 1e-12 * force.elastic);
}

TEST(sphere_contact, friction_holds_what_pulls_less_than_it_without_creep) {
  // A block on another, pulled along by half of mu N: it comes to rest a little farther on and stays there.
  const auto law = contact(DampingCap::step);
  const Real pull = 0.5 * 0.58 * 1500;
  Real speed = 0, moved = 0;
  SphereMemory memory;
  for (int step = 0; step < 4000; ++step) {
    SphereMotion at = closing(0);
    at.sliding = {0, speed, 0};
    const Real friction = sphere_force(law, at, memory).friction.y();
    speed += at.step * (pull + friction) / at.sliding_mass;
    moved += at.step * speed;
    if (step == 2000) moved = 0;
  }
  EXPECT_LT(std::abs(moved), 1e-20);
  EXPECT_NEAR(memory.friction.y(), -pull, 1e-9 * pull);
}

TEST(sphere_contact, friction_turns_round_with_the_sliding) {
  const auto law = contact(DampingCap::step);
  SphereMemory memory;
  SphereMotion at = closing(0);
  at.sliding = {0, 10, 0};
  for (int step = 0; step < 10; ++step) EXPECT_LT(sphere_force(law, at, memory).friction.y(), 0);
  at.sliding = {0, -10, 0};
  SphereForce force;
  for (int step = 0; step < 10; ++step) force = sphere_force(law, at, memory);
  EXPECT_DOUBLE_EQ(force.friction.y(), 0.58 * force.elastic);
}

TEST(sphere_contact, friction_counts_the_dashpots_share_of_the_normal_force) {
  SphereMotion at = closing(1e-3);
  at.sliding = {0, 0, 100};
  EXPECT_NEAR(first_force(contact(DampingCap::literal), at).friction.norm(), 0.58 * (1500.0 + 3080.0), 1e-9);
}

}  // namespace
}  // namespace sazare::laws
