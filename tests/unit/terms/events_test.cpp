#include <gtest/gtest.h>

#include <thread>

#include "sazare/levels/terms/events.hpp"

namespace sazare::terms {
namespace {

TEST(events, come_out_in_order_and_once) {
  Events events;
  for (const Index what : {5, 1, 3, 5, 1}) events.add(what);
  EXPECT_EQ(events.take(), (std::vector<Index>{1, 3, 5}));
  EXPECT_TRUE(events.take().empty());
}

TEST(events, from_several_threads_none_is_lost) {
  Events events;
  std::vector<std::thread> threads;
  for (Index thread = 0; thread < 4; ++thread)
    threads.emplace_back([&events, thread] {
      for (Index i = 0; i < 1000; ++i) events.add(4 * i + thread);
    });
  for (auto& thread : threads) thread.join();
  const auto taken = events.take();
  ASSERT_EQ(taken.size(), 4000u);
  for (Index i = 0; i < 4000; ++i) EXPECT_EQ(taken[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace sazare::terms
