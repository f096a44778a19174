#include "sazare/core/coming_lines.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace sazare {
namespace {

TEST(coming_lines, counts_the_lines_of_parts_and_of_single_records) {
  struct alignas(32) Record {
    double numbers[4];
  };
  const std::vector<Record> table(100);
  const std::vector<Index> places{3, 99, 7};
  ComingLines coming;
  EXPECT_EQ(coming.lines(), 0u);
  coming.add(std::span(table).subspan(10, 5));  // 160 bytes
  EXPECT_EQ(coming.lines(), 3u);
  coming.add(std::span<const Record>(table), std::span(places));
  EXPECT_EQ(coming.lines(), 6u);
  coming.add(std::span(table).first(0));
  EXPECT_EQ(coming.lines(), 6u);
}

TEST(coming_lines, asks_for_everything_once_and_then_for_nothing) {
  const std::vector<double> table(1000);
  ComingLines coming;
  for (int n = 0; n < 20; ++n) coming.add(std::span(table));  // more parts than it takes
  const std::size_t lines = coming.lines();
  EXPECT_EQ(lines % 125, 0u);
  EXPECT_EQ(coming.left(), lines);
  coming.fetch(7);
  EXPECT_EQ(coming.left(), lines - 7);
  coming.fetch(200);
  EXPECT_EQ(coming.left(), lines - 207);
  coming.fetch(lines);
  EXPECT_EQ(coming.left(), 0u);
  coming.fetch(1);
  EXPECT_EQ(coming.left(), 0u);
}

}  // namespace
}  // namespace sazare
