#include "sazare/parallel/progress.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "sazare/parallel/threads.hpp"

namespace sazare::parallel {
namespace {

class ProgressOfShares : public testing::Test {
protected:
  void TearDown() override { set_threads(0); }
};

TEST_F(ProgressOfShares, what_was_done_before_is_seen) {
  constexpr std::size_t shares = 4, tasks = 300;
  set_threads(static_cast<int>(shares));
  Progress progress(shares);
  std::vector<std::vector<std::size_t>> done(shares, std::vector<std::size_t>(tasks, 0));
  std::vector<std::size_t> seen(shares, 0);
  parallel_for(shares, 2, [&](std::size_t begin, std::size_t end) {
    for (std::size_t share = begin; share < end; ++share)
      for (std::size_t task = 0; task < tasks; ++task) {
        done[share][task] = task;
        progress.set(share, task + 1);
        if (share == 0) continue;
        EXPECT_TRUE(progress.wait(share - 1, task + 1));
        seen[share] += done[share - 1][task];
      }
  });
  for (std::size_t share = 1; share < shares; ++share) EXPECT_EQ(seen[share], tasks * (tasks - 1) / 2);
}

TEST_F(ProgressOfShares, one_that_nobody_has_begun_is_told) {
  Progress progress(2);
  progress.begin(1);
  EXPECT_FALSE(progress.has_begun(0));
  EXPECT_TRUE(progress.has_begun(1));
}

TEST_F(ProgressOfShares, nobody_waits_for_what_has_failed) {
  set_threads(3);
  Progress progress(3);
  const auto run = [&] {
    parallel_for(3, 2, [&](std::size_t begin, std::size_t end) {
      for (std::size_t share = begin; share < end; ++share) {
        if (share > 0) {
          EXPECT_FALSE(progress.wait(0, 7));
          continue;
        }
        progress.give_up();
        throw std::runtime_error("the first share");
      }
    });
  };
  EXPECT_THROW(run(), std::runtime_error);
}

}  // namespace
}  // namespace sazare::parallel
