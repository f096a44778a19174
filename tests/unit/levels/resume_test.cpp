/// A run that goes on from a checkpoint is the run that was never stopped, bit for bit.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/memory_archive.hpp"
#include "tests/support/networks.hpp"

namespace sazare::levels {
namespace {

StepRules travel() { return {.base_step = 0.04, .stability = false, .travel_length = 0.01, .neighbor_levels = 2}; }

template <int D>
void expect_same_run(const StepRules& rules, int before, int after) {
  auto whole = test::ladder<D>().simulation(rules), first = test::ladder<D>().simulation(rules);
  whole.start();
  test::run(whole, before + after);
  first.start();
  test::run(first, before);
  test::MemoryArchive checkpoint;
  first.columns(checkpoint);
  checkpoint.turn_round();
  auto second = test::ladder<D>().simulation(rules);
  second.columns(checkpoint);
  test::run(second, after);
  for (std::size_t body = 0; body < 6; ++body) {
    EXPECT_EQ(second.bodies().motion[body].position, whole.bodies().motion[body].position);
    EXPECT_EQ(second.bodies().motion[body].angular_momentum, whole.bodies().motion[body].angular_momentum);
    EXPECT_EQ(second.bodies().motion[body].rotation, whole.bodies().motion[body].rotation);
    EXPECT_EQ(second.levels().level(static_cast<Index>(body)), whole.levels().level(static_cast<Index>(body)));
  }
  EXPECT_EQ(second.energy_balance().joules, whole.energy_balance().joules);
  EXPECT_EQ(second.counters().pair_evaluations, whole.counters().pair_evaluations);
  EXPECT_EQ(second.now().tick, whole.now().tick);
}

TEST(engine_resume, at_any_base_step_with_levels_by_stability) {
  for (const int before : {0, 1, 7, 20}) expect_same_run<3>({.base_step = 0.08}, before, 30 - before);
}

TEST(engine_resume, at_any_base_step_while_levels_change) {
  for (const int before : {0, 1, 7, 20}) {
    expect_same_run<2>(travel(), before, 30 - before);
    expect_same_run<3>(travel(), before, 30 - before);
  }
}

TEST(engine_resume, a_checkpoint_does_not_disturb_the_run) {
  auto simulation = test::ladder<3>().simulation(travel()), other = test::ladder<3>().simulation(travel());
  simulation.start();
  other.start();
  for (int step = 0; step < 10; ++step) {
    test::MemoryArchive checkpoint;
    simulation.columns(checkpoint);
    simulation.energy_balance();
    simulation.advance();
    other.advance();
  }
  EXPECT_EQ(simulation.bodies().motion[3].position, other.bodies().motion[3].position);
}

}  // namespace
}  // namespace sazare::levels
