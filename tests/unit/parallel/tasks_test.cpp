#include "sazare/parallel/tasks.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "sazare/parallel/threads.hpp"

namespace sazare::parallel {
namespace {

TEST(tasks, each_is_done_once_and_alone_on_its_thread) {
  std::vector<std::atomic<int>> done(100);
  run_tasks(done.size(), 3, [&](std::size_t i) {
    EXPECT_EQ(threads(), 1);
    ++done[i];
  });
  for (const auto& count : done) EXPECT_EQ(count, 1);
  set_threads(0);
}

TEST(tasks, first_failure_ends_the_rest_and_reaches_the_caller) {
  std::atomic<int> begun = 0;
  const auto failing = [&](std::size_t i) {
    ++begun;
    if (i == 2) throw std::runtime_error("task 2");
  };
  EXPECT_THROW(run_tasks(1000, 1, failing), std::runtime_error);
  EXPECT_EQ(begun, 3);
  set_threads(0);
}

}  // namespace
}  // namespace sazare::parallel
