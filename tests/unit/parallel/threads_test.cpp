#include "sazare/parallel/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace sazare::parallel {
namespace {

using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

Ranges ranges_of(std::size_t n, std::size_t serial_below) {
  Ranges ranges;
  std::mutex lock;
  parallel_for(n, serial_below, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard guard(lock);
    ranges.emplace_back(begin, end);
  });
  std::sort(ranges.begin(), ranges.end());
  return ranges;
}

class Threads : public testing::Test {
protected:
  void TearDown() override { set_threads(0); }
};

TEST_F(Threads, number_is_what_was_set) {
  set_threads(3);
  EXPECT_EQ(threads(), 3);
  set_threads(0);
  EXPECT_GE(threads(), 1);
  set_threads(-2);
  EXPECT_GE(threads(), 1);
}

TEST_F(Threads, one_contiguous_range_per_thread_of_nearly_one_length) {
  set_threads(4);
  EXPECT_EQ(ranges_of(10, 0), (Ranges{{0, 3}, {3, 6}, {6, 8}, {8, 10}}));
}

TEST_F(Threads, every_index_exactly_once) {
  for (const int count : {1, 2, 3, 5, 8}) {
    set_threads(count);
    for (const std::size_t n : {0, 1, 2, 3, 7, 100, 1001}) {
      std::vector<int> visits(n, 0);
      parallel_for(n, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(n, 1)) << count << " threads";
    }
  }
}

TEST_F(Threads, uneven_loop_reaches_every_index_exactly_once) {
  for (const int count : {1, 2, 3, 8}) {
    set_threads(count);
    for (const std::size_t n : {0, 1, 2, 7, 100, 1001}) {
      std::vector<int> visits(n, 0);
      parallel_for_uneven(n, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(n, 1)) << count << " threads";
    }
  }
}

TEST_F(Threads, who_is_done_in_an_uneven_loop_helps_the_others) {
  set_threads(2);
  std::atomic<int> done = 0;
  parallel_for_uneven(8, 0, [&](std::size_t begin, std::size_t) {
    while (begin == 0 && done < 7) std::this_thread::yield();  // ends only if the other thread does all the rest
    ++done;
  });
  EXPECT_EQ(done, 8);
}

TEST_F(Threads, short_loops_and_one_thread_are_serial) {
  set_threads(4);
  EXPECT_EQ(ranges_of(99, 100), (Ranges{{0, 99}}));
  EXPECT_EQ(ranges_of(100, 100).size(), 4u);
  set_threads(1);
  EXPECT_EQ(ranges_of(1000, 0), (Ranges{{0, 1000}}));
}

TEST_F(Threads, empty_loop_calls_nothing) {
  set_threads(2);
  EXPECT_TRUE(ranges_of(0, 0).empty());
}

TEST_F(Threads, loop_inside_a_loop_is_serial) {
  set_threads(2);
  std::vector<std::size_t> inner_ranges(2, 0);
  parallel_for(2, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      parallel_for(50, 0, [&](std::size_t, std::size_t) { ++inner_ranges[i]; });
    }
  });
  EXPECT_EQ(inner_ranges, (std::vector<std::size_t>{1, 1}));
}

TEST_F(Threads, exception_of_the_lowest_range_reaches_the_caller) {
  set_threads(4);
  for (int repeat = 0; repeat < 50; ++repeat) {
    try {
      parallel_for(4, 0, [](std::size_t begin, std::size_t) {
        if (begin >= 1) throw std::runtime_error(std::to_string(begin));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "1");
    }
  }
}

TEST_F(Threads, what_a_loop_wrote_is_seen_after_it_and_by_the_next) {
  set_threads(4);
  std::vector<long> values(10000);
  std::iota(values.begin(), values.end(), 0L);
  for (int repeat = 0; repeat < 100; ++repeat) {
    std::vector<long> next(values.size());
    parallel_for(values.size(), 0, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) next[i] = values[values.size() - 1 - i] + 1;
    });
    values.swap(next);
  }
  EXPECT_EQ(values.front(), 100);
  EXPECT_EQ(values.back(), 9999 + 100);
}

TEST_F(Threads, constant_function_objects_will_do) {
  set_threads(2);
  std::vector<char> seen(10, 0);
  const auto mark = [&](std::size_t begin, std::size_t end) {
    std::fill(seen.begin() + static_cast<long>(begin), seen.begin() + static_cast<long>(end), 1);
  };
  parallel_for(seen.size(), 0, mark);
  EXPECT_EQ(seen, std::vector<char>(10, 1));
}

TEST_F(Threads, a_limit_holds_unless_a_number_was_set) {
  set_threads(3);
  limit_threads(1);
  EXPECT_EQ(threads(), 3);
  set_threads(0);
  limit_threads(0);
  EXPECT_EQ(threads(), 1);
}

}  // namespace
}  // namespace sazare::parallel
