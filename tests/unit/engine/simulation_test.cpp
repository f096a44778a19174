#include "sazare/engine/simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/networks.hpp"

namespace sazare::engine {
namespace {

TEST(simulation, time_is_counted_in_whole_base_steps) {
  auto simulation = test::ladder<3>().simulation({.base_step = 0.08});
  simulation.start();
  EXPECT_EQ(simulation.now().seconds(), 0);
  test::run(simulation, 25);
  EXPECT_EQ(simulation.now().tick, 25 * schedule::base_stride);
  EXPECT_DOUBLE_EQ(simulation.now().seconds(), 2.0);
  for (const auto& motion : simulation.bodies().motion) EXPECT_EQ(motion.last_kick, simulation.now().tick);
}

TEST(simulation, says_where_its_time_went) {
  auto simulation = test::ladder<3>().simulation({.base_step = 0.08});
  simulation.start();
  test::run(simulation, 10);
  std::vector<std::string> parts;
  Real sum = 0;
  for (const auto& part : simulation.part_times()) {
    parts.push_back(part.part);
    sum += part.seconds;
    EXPECT_GE(part.seconds, 0);
  }
  EXPECT_EQ(parts, (std::vector<std::string>{"springs", "bodies", "schedule"}));
  EXPECT_GT(sum, 0);
}

TEST(simulation, the_smallest_step_is_that_since_it_was_asked_for) {
  // A body that slows down: levels become coarser, and the finest is forgotten once it was told.
  test::Network<2> network;
  state::add_body(network.bodies, 1.0, Vector<2>(0, 0), 1.0, 0.0);
  network.bodies.motion[0].velocity.x() = 1;
  network.springs.push_back({0, Link::outside, Vector<2>::Zero(), Vector<2>(-10, 0), 10.0, 1.0, 0, 0});
  auto simulation = network.simulation({.base_step = 0.05, .stability = false, .travel_length = 0.01});
  simulation.start();
  const Real fast = simulation.take_smallest_step();
  EXPECT_DOUBLE_EQ(fast, 0.05 / 8);
  while (simulation.bodies().motion[0].velocity.x() > 0.3) simulation.advance();
  simulation.take_smallest_step();
  simulation.advance();
  EXPECT_GT(simulation.take_smallest_step(), fast);
}

TEST(simulation, an_unlinked_body_flies_straight_on_at_the_base_step) {
  test::Network<3> network;
  test::add_body_at(network.bodies, 1.0, 0, 0);
  network.bodies.motion[0].velocity = {1, 2, 3};
  auto simulation = network.simulation({.base_step = 0.5});
  simulation.start();
  test::run(simulation, 4);
  EXPECT_EQ(simulation.snapshot().pose[0].position, Vector3(2, 4, 6));
  EXPECT_EQ(simulation.levels().level(0), 0);
  EXPECT_EQ(simulation.counters().kicks, 5);
}

}  // namespace
}  // namespace sazare::engine
