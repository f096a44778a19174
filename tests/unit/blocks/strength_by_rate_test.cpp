/// Joints whose strength follows the rate at which they are opened. The probe lets a second pass between two evaluations.

#include "sazare/methods/blocks/strength_by_rate.hpp"

#include <gtest/gtest.h>

#include "tests/support/bonded_pair.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare::methods::blocks {
namespace {

using sazare::test::BondedPair;
using terms::EnergyKind;

constexpr Real strength = 6.66e6, energy = 99.67, shear_energy = 400;
constexpr Real elastic_opening = strength / 450e9, failure_opening = 2 * energy / strength;
constexpr Real strain_per_opening = 1e7;  // so that 1e-7 m in a second are 1/s

cases::Joint joint_of(laws::JointLawName law, laws::RateLawName rate_law = laws::RateLawName::fib_2010) {
  cases::Joint joint = test::concrete_joint("left", "right");
  joint.law = law;
  for (std::size_t n = 0; n < joint.law_parameters.size(); ++n)
    if (law == laws::JointLawName::mixed_mode)
      joint.law_parameters[n] = laws::parameters_of_laws<laws::JointLaws>[n].unit == "N/m" ? shear_energy : 0.4;
  joint.by_rate.law = rate_law;
  return joint;
}

/// Opens the pair at a steady rate; the largest stress on the way [Pa].
Real strongest(BondedPair& pair, Real from, Real to, Real opening_per_second) {
  Real most = 0;
  for (Real opening = from; opening < to; opening += opening_per_second) {
    pair.place(opening);
    most = std::max(most, pair.stress().x());
  }
  return most;
}

TEST(StrengthByRate, takes_energy_by_its_own_power) {
  for (const Real exponent : {0.0, 0.5, 2.0}) {
    cases::Joint joint = joint_of(laws::JointLawName::mixed_mode);
    joint.by_rate.energy_exponent = exponent;
    const Real step = 2e-9, rate = 1, factor = joint.by_rate.factor(rate);
    BondedPair pair(joint, rate / step);
    EXPECT_NEAR(strongest(pair, 0, 1.01 * factor * failure_opening, step), factor * strength, 2e-4 * strength);
    const Real taken = std::pow(factor, exponent) * energy * pair.area();
    EXPECT_NEAR(pair.probe().energy_balance()[EnergyKind::fracture], taken, 1e-3 * taken) << exponent;
  }
}

class ByRate : public testing::TestWithParam<laws::JointLawName> {};

TEST_P(ByRate, pulled_steadily_it_has_the_strength_and_takes_the_energy_of_that_rate) {
  for (const Real rate : {1e-4, 1e-2, 0.1}) {
    const Real step = 2e-9;  // m in a second
    BondedPair pair(joint_of(GetParam()), rate / step);
    const Real factor = joint_of(GetParam()).by_rate.factor(rate);
    EXPECT_GT(factor, 1.08);
    EXPECT_NEAR(strongest(pair, 0, 1.01 * failure_opening, step), factor * strength, 2e-4 * strength) << rate;
    EXPECT_NEAR(pair.joints().strength_factor(0), factor, 1e-6 * factor) << rate;
    EXPECT_EQ(pair.joints().state(0), JointState::broken);
    EXPECT_NEAR(pair.probe().energy_balance()[EnergyKind::fracture], factor * energy * pair.area(), 1e-3 * energy * pair.area());
  }
}

TEST_P(ByRate, without_a_rate_law_or_at_rest_it_is_the_static_joint) {
  BondedPair slow(joint_of(GetParam()), 1e-9), plain(joint_of(GetParam(), laws::RateLawName::none));
  for (Real opening = 0; opening < 1.01 * failure_opening; opening += 2e-8) {
    slow.place(opening, 0.1 * opening);
    plain.place(opening, 0.1 * opening);
    EXPECT_EQ(slow.stress(), plain.stress()) << opening;
  }
  EXPECT_FALSE(plain.joints().follow_rates());
}

TEST_P(ByRate, what_has_softened_keeps_its_strength_whatever_comes_and_cycles_take_energy) {
  BondedPair pair(joint_of(GetParam()), strain_per_opening);
  Real work = 0, before = 0, last = 0;
  const auto go = [&](Real to, int steps) {
    const Real from = last;
    for (int step = 1; step <= steps; ++step) {
      const Real opening = from + (to - from) * step / steps;
      pair.place(opening);
      const Real force = pair.stress().x() * pair.area();
      work += 0.5 * (before + force) * (opening - last);
      before = force;
      last = opening;
    }
  };
  go(0.8 * failure_opening, 4000);
  const Real factor = pair.joints().strength_factor(0);
  EXPECT_EQ(pair.joints().state(0), JointState::softening);
  EXPECT_GT(factor, 1.01);
  go(-elastic_opening, 100);
  go(0.8 * failure_opening, 50);  // much faster
  go(0, 10000);
  EXPECT_EQ(pair.joints().strength_factor(0), factor);
  const auto balance = pair.probe().energy_balance();
  EXPECT_GT(work, 0);
  EXPECT_NEAR(work, balance[EnergyKind::fracture], 1e-2 * work);
  EXPECT_NEAR(balance[EnergyKind::elastic], 0, 1e-9 * work);
}

TEST_P(ByRate, force_is_the_slope_of_the_energy_before_and_after_it_softens) {
  for (const Real opening : {0.8 * elastic_opening, 0.8 * failure_opening}) {
    BondedPair pair(joint_of(GetParam()), strain_per_opening);
    strongest(pair, 0, opening, opening / 50);
    const auto forces = pair.forces();
    for (int freedom = 0; freedom < 6; ++freedom)
      EXPECT_NEAR(test::component(forces[1], freedom), test::energy_slope(pair.probe(), pair.bodies(), 1, freedom, 1e-12),
                  1e-4 * forces[1].linear.norm())
          << freedom;
  }
}

TEST_P(ByRate, a_checkpoint_has_the_strength) {
  BondedPair pair(joint_of(GetParam()), strain_per_opening), other(joint_of(GetParam()), strain_per_opening);
  strongest(pair, 0, 0.8 * failure_opening, 1e-8);
  test::MemoryArchive archive;
  pair.joints().columns(archive);
  archive.turn_round();
  other.joints().columns(archive);
  EXPECT_GT(other.joints().strength_factor(0), 1.01);
  EXPECT_EQ(other.joints().strength_factor(0), pair.joints().strength_factor(0));
  pair.place(0.9 * failure_opening);
  other.place(0.9 * failure_opening);
  EXPECT_EQ(other.stress(), pair.stress());
}

INSTANTIATE_TEST_SUITE_P(Laws, ByRate, testing::Values(laws::JointLawName::linear_softening, laws::JointLawName::mixed_mode));

TEST(StrengthByRate, forgets_what_shook_below_half_of_the_strength) {
  StrengthByRate by_rate({{laws::RateLawName::fib_2010, {}}}, {{0, 1}});
  const Real before = 1e3;
  // Shaken at a strain rate of some 1e3/s around a tenth of the strength, then loaded in ten seconds.
  for (int step = 1; step <= 10; ++step) by_rate.follow(0, 1e-6 * step, step % 2 == 0 ? 1e-4 : 2e-4, 1e-3, before);
  for (int step = 1; step <= 10; ++step) by_rate.follow(0, 1 + step, 1e-4 * step + 1e-5, 1e-3, before);
  EXPECT_NEAR(by_rate.factor(0), laws::FibIncrease::factor(1e-4, {}), 1e-12);
}

TEST(StrengthByRate, is_at_most_what_leaves_the_joint_something_to_soften) {
  StrengthByRate by_rate({{laws::RateLawName::fib_2010, {}}}, {{0, 1e9}});
  by_rate.follow(0, 1, 0, 1e-6, 1.2e-6);
  by_rate.follow(0, 1.001, 2e-6, 1e-6, 1.2e-6);
  EXPECT_DOUBLE_EQ(by_rate.factor(0), 1.2);
}

TEST(StrengthByRate, leaves_any_factor_to_joints_whose_process_zone_keeps_its_length) {
  StrengthByRate by_rate({{laws::RateLawName::fib_2010, {}, 2}}, {{0, 1e9}});
  by_rate.follow(0, 1, 0, 1e-6, 1.2e-6);
  by_rate.follow(0, 1.001, 2e-6, 1e-6, 1.2e-6);
  EXPECT_DOUBLE_EQ(by_rate.factor(0), laws::FibIncrease::factor(300, {}));
  EXPECT_DOUBLE_EQ(by_rate.length_factor(0), by_rate.factor(0));
}

TEST(StrengthByRate, begins_anew_where_the_joint_stands_when_the_run_begins) {
  StrengthByRate by_rate({{laws::RateLawName::fib_2010, {}}}, {{0, 1e9}});
  by_rate.follow(0, 0, 0.9e-6, 1e-6, 1);  // under stress
  by_rate.follow(0, 1e-9, 0.9e-6, 1e-6, 1);
  EXPECT_EQ(by_rate.factor(0), 1);
}

TEST(StrengthByRate, begins_anew_when_time_begins) {
  StrengthByRate by_rate({{laws::RateLawName::fib_2010, {}}}, {{0, 1e3}});
  by_rate.follow(0, -1e9, 0.6e-3, 1e-3, 1);  // while bodies come to rest
  by_rate.follow(0, 0, 0.6e-3, 1e-3, 1);
  by_rate.follow(0, 0.1, 0.7e-3, 1e-3, 1);
  EXPECT_DOUBLE_EQ(by_rate.factor(0), laws::FibIncrease::factor(1, {}));
}

}  // namespace
}  // namespace sazare::methods::blocks
