#include "sazare/core/large_tables.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace sazare {
namespace {

/// Whether the system grants a large page is its own affair; what stands on one stays what it is either way.
TEST(large_tables, keep_what_they_hold_on_large_pages) {
  std::vector<std::uint64_t> large(std::size_t{3} << 20), small(100);
  std::iota(large.begin(), large.end(), 0);
  std::iota(small.begin(), small.end(), 7);
  const std::vector<std::uint64_t> before = large, small_before = small;
  LargePages pages;
  pages.add(large);
  pages.add(small);
  pages.add(std::vector<std::uint64_t>{});
  pages.ask();
  EXPECT_EQ(large, before);
  EXPECT_EQ(small, small_before);
  large.front() = 5;
  large.back() = 6;
  EXPECT_EQ(std::accumulate(large.begin(), large.end(), std::uint64_t{0}),
            std::accumulate(before.begin(), before.end(), std::uint64_t{0}) + 5 + 6 - before.front() - before.back());
}

}  // namespace
}  // namespace sazare
