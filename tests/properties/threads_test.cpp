/// Results do not depend on the number of threads, to the last bit.

#include <gtest/gtest.h>

#include "sazare/parallel/threads.hpp"
#include "tests/properties/slab.hpp"

namespace sazare {
namespace {

std::string run_with(int threads, const test::SlabRules& rules, int base_steps, Index least_broken) {
  parallel::set_threads(threads);
  auto model = test::slab(rules);
  model.simulation->start();
  test::advance(model, base_steps);
  EXPECT_GE(model.joints->broken_count(), least_broken);
  EXPECT_GE(test::levels_in_use(model).second - test::levels_in_use(model).first, 2);
  parallel::set_threads(1);
  return test::fingerprint(model);
}

void expect_same_bits(const test::SlabRules& rules, int base_steps, Index least_broken) {
  const std::string alone = run_with(1, rules, base_steps, least_broken);
  for (const int threads : {2, 4})
    EXPECT_TRUE(run_with(threads, rules, base_steps, least_broken) == alone) << threads << " threads give other bits";
}

TEST(threads, give_the_same_bits_with_the_stability_limiter) { expect_same_bits({}, 100, 40); }

TEST(threads, give_the_same_bits_with_deformable_elements) {
  test::SlabRules rules;
  rules.deformable = true;
  expect_same_bits(rules, 100, 5);
}

TEST(threads, give_the_same_bits_while_levels_change_and_bodies_wake) {
  expect_same_bits({cases::Limiter::travel, cases::Levels::per_element}, 200, 5);
}

TEST(threads, give_the_same_bits_with_springs_of_the_elements) {
  expect_same_bits({cases::Limiter::stability, cases::Levels::per_element, true}, 100, 40);
}

TEST(threads, give_the_same_bits_where_true_faces_touch) {
  test::SlabRules rules;
  rules.contact = cases::ContactShape::faces;
  expect_same_bits(rules, 100, 40);
}

TEST(threads, a_difference_of_one_bit_would_show) {
  parallel::set_threads(1);
  auto model = test::slab(), other = test::slab();
  EXPECT_TRUE(test::fingerprint(model) == test::fingerprint(other));
  model.simulation->start();
  other.simulation->start();
  EXPECT_TRUE(test::fingerprint(model) == test::fingerprint(other));
  test::advance(model, 1);
  EXPECT_FALSE(test::fingerprint(model) == test::fingerprint(other));
}

}  // namespace
}  // namespace sazare
