#include <gtest/gtest.h>

#include "sazare/levels/limiters.hpp"

namespace sazare::levels {
namespace {

TEST(limiters, without_dashpots_the_limit_is_two_over_the_frequency) { EXPECT_DOUBLE_EQ(stable_step({100.0, 0}), 0.2); }

TEST(limiters, without_springs_it_is_two_over_the_rate_of_the_dashpot) { EXPECT_DOUBLE_EQ(stable_step({0, 10.0}), 0.2); }

TEST(limiters, a_free_body_has_no_limit) { EXPECT_TRUE(std::isinf(stable_step({}))); }

TEST(limiters, both_together_it_is_the_root_of_the_formula) {
  const Real h = stable_step({100.0, 7.0});
  EXPECT_NEAR(100 * h * h + 2 * 7 * h, 4, 1e-13);
}

/// Largest displacement of one mass after many steps of leapfrog with the dashpot's velocity predicted by the mean of its last
/// two forces.
Real swing(Real stiffness, Real damping, Real h) {
  Real x = 1, v = 0, predicted = 0, last = -stiffness, largest = 0;
  for (int step = 0; step < 2000; ++step) {
    const Real acceleration = -stiffness * x - damping * predicted;
    v += (step == 0 ? h / 2 : h) * acceleration;
    predicted = v + h / 4 * (acceleration + last);
    last = acceleration;
    x += h * v;
    if (step > 1000) largest = std::max(largest, std::abs(x));
  }
  return largest;
}

TEST(limiters, just_below_the_limit_a_swing_stays_and_just_above_it_grows) {
  for (const Real damping : {0.0, 1.0, 7.0, 40.0}) {
    const Real h = stable_step({100.0, damping});
    EXPECT_LT(swing(100, damping, 0.99 * h), 100) << damping;
    EXPECT_GT(swing(100, damping, 1.01 * h), 1e6) << damping;
  }
}

TEST(limiters, travel_allows_the_length_in_a_step) { EXPECT_DOUBLE_EQ(travel_speed(1e-10, 1e-8), 100); }

}  // namespace
}  // namespace sazare::levels
