/// A run that goes on from a checkpoint is the run that was never stopped: with broken joints, contacts and levels.

#include <gtest/gtest.h>

#include <algorithm>

#include "sazare/parallel/threads.hpp"
#include "tests/properties/slab.hpp"
#include "tests/support/memory_archive.hpp"

namespace sazare {
namespace {

test::MemoryArchive checkpoint_of(runs::BlocksModel& model) {
  test::MemoryArchive checkpoint;
  model.simulation->columns(checkpoint);
  checkpoint.turn_round();
  return checkpoint;
}

void expect_resumed_is_uninterrupted(const test::SlabRules& rules, std::vector<int> stops, int end) {
  parallel::set_threads(1);
  auto whole = test::slab(rules);
  whole.simulation->start();
  int step = 0;
  std::vector<test::MemoryArchive> checkpoints;
  for (const int stop : stops) {  // writing checkpoints must not disturb the run: it is compared with those resumed from them
    test::advance(whole, stop - step);
    step = stop;
    checkpoints.push_back(checkpoint_of(whole));
  }
  test::advance(whole, end - step);
  EXPECT_GT(whole.joints->broken_count(), 0);
  EXPECT_GT(whole.contacts->pair_count(), 0);
  const std::string expected = test::fingerprint(whole);
  for (std::size_t i = 0; i < stops.size(); ++i) {
    auto resumed = test::slab(rules);
    resumed.simulation->columns(checkpoints[i]);
    test::advance(resumed, end - stops[i]);
    EXPECT_TRUE(test::fingerprint(resumed) == expected) << "resumed at base step " << stops[i];
  }
}

/// At 71 pairs of contacts have just ended.
TEST(resume, at_any_base_step_with_the_stability_limiter) { expect_resumed_is_uninterrupted({}, {0, 37, 71, 99}, 100); }

TEST(resume, at_any_base_step_with_springs_of_the_elements) {
  expect_resumed_is_uninterrupted({cases::Limiter::stability, cases::Levels::per_element, true}, {0, 37, 71, 99}, 100);
}

TEST(resume, at_any_base_step_with_deformable_elements) {
  test::SlabRules rules;
  rules.deformable = true;
  expect_resumed_is_uninterrupted(rules, {0, 37, 71, 99}, 100);
}

TEST(resume, at_any_base_step_where_true_faces_touch) {
  test::SlabRules rules;
  rules.contact = cases::ContactShape::faces;
  expect_resumed_is_uninterrupted(rules, {0, 37, 71, 99}, 100);
}

TEST(resume, at_any_base_step_while_levels_change_and_bodies_wake) {
  expect_resumed_is_uninterrupted({cases::Limiter::travel, cases::Levels::per_element}, {1, 120, 203}, 220);
}

/// Stopped on its way from one base step to the next, where only the finer levels are in phase.
TEST(resume, within_a_base_step) {
  const test::SlabRules rules{cases::Limiter::travel, cases::Levels::per_element};
  parallel::set_threads(1);
  auto whole = test::slab(rules);
  whole.simulation->start();
  test::advance(whole, 120);
  std::vector<test::MemoryArchive> checkpoints;
  std::vector<Tick> ticks;
  for (int step = 120; step < 125; ++step) {
    whole.simulation->advance([&] {
      ticks.push_back(whole.simulation->now().tick);
      checkpoints.push_back(checkpoint_of(whole));
      return false;
    });
  }
  ASSERT_TRUE(std::ranges::any_of(ticks, [](Tick tick) { return tick % schedule::base_stride != 0; }));
  const std::string expected = test::fingerprint(whole);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    auto resumed = test::slab(rules);
    resumed.simulation->columns(checkpoints[i]);
    while (resumed.simulation->now().tick < whole.simulation->now().tick) resumed.simulation->advance();
    EXPECT_TRUE(test::fingerprint(resumed) == expected) << "resumed at tick " << ticks[i];
  }
}

TEST(resume, a_checkpoint_holds_broken_joints_contacts_and_levels) {
  parallel::set_threads(1);
  auto model = test::slab();
  model.simulation->start();
  test::advance(model, 80);
  ASSERT_GT(model.joints->broken_count(), 10);
  auto checkpoint = checkpoint_of(model);
  auto resumed = test::slab();
  resumed.simulation->columns(checkpoint);
  EXPECT_EQ(resumed.joints->broken_count(), model.joints->broken_count());
  EXPECT_EQ(resumed.contacts->pair_count(), model.contacts->pair_count());
  EXPECT_TRUE(test::fingerprint(resumed) == test::fingerprint(model));
}

TEST(resume, another_number_of_threads_may_go_on) {
  parallel::set_threads(1);
  auto model = test::slab();
  model.simulation->start();
  test::advance(model, 60);
  auto checkpoint = checkpoint_of(model);
  test::advance(model, 40);
  auto resumed = test::slab();
  resumed.simulation->columns(checkpoint);
  parallel::set_threads(3);
  test::advance(resumed, 40);
  parallel::set_threads(1);
  EXPECT_TRUE(test::fingerprint(resumed) == test::fingerprint(model));
}

}  // namespace
}  // namespace sazare
