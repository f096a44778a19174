#include "sazare/core/lane_records.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace sazare {
namespace {

struct Record {
  std::array<Real, 12> number{};
};

/// As many records as there are lanes; every number another one.
std::vector<Record> records() {
  std::vector<Record> all(lane_count);
  for (std::size_t lane = 0; lane < all.size(); ++lane)
    for (std::size_t i = 0; i < 12; ++i) all[lane].number[i] = static_cast<Real>(100 * lane + i);
  return all;
}

/// In another order than in memory.
LanePointers<Record> pointers(std::vector<Record>& all) {
  LanePointers<Record> to;
  for (std::size_t lane = 0; lane < lane_count; ++lane) to[lane] = &all[(3 * lane + 1) % lane_count];
  return to;
}

TEST(lane_records, a_quad_is_four_numbers_of_each_record_from_any_number_on) {
  auto all = records();
  const auto from = pointers(all);
  for (std::size_t begin = 0; begin <= 8; ++begin) {
    const auto quad = load_quad(from, begin);
    for (std::size_t lane = 0; lane < lane_count; ++lane)
      for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(quad[i][static_cast<int>(lane)], from[lane]->number[begin + i]);
  }
}

TEST(lane_records, whole_records_are_read_likewise) {
  auto all = records();
  const auto from = pointers(all);
  const auto fields = load_records<12>(from);
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(fields[i][static_cast<int>(lane)], from[lane]->number[i]);
}

TEST(lane_records, a_quad_is_written_where_it_belongs_and_nowhere_else) {
  auto all = records();
  const auto to = pointers(all);
  store_quad(load_quad(to, 0), to, 5);
  for (const auto* record : to)
    for (std::size_t i = 0; i < 12; ++i)
      EXPECT_EQ(record->number[i] - record->number[0], static_cast<Real>(i >= 5 && i < 9 ? i - 5 : i));
}

TEST(lane_records, lanes_may_share_a_record) {
  auto all = records();
  auto to = pointers(all);
  for (std::size_t lane = 3; lane < lane_count; ++lane) to[lane] = to[0];
  const auto quad = load_quad(to, 0);
  store_quad(quad, to, 5);
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(to[lane]->number[5 + i], quad[i][static_cast<int>(lane)]);
}

TEST(lane_records, a_square_is_turned_over_its_diagonal) {
  std::array<Lanes, lane_count> rows;
  for (std::size_t row = 0; row < lane_count; ++row)
    for (int lane = 0; lane < lane_count; ++lane) rows[row][lane] = static_cast<Real>(10 * row) + lane;
  transpose(rows);
  for (std::size_t row = 0; row < lane_count; ++row)
    for (int lane = 0; lane < lane_count; ++lane) EXPECT_EQ(rows[row][lane], 10.0 * lane + static_cast<Real>(row));
}

TEST(lane_records, numbers_in_single_precision_stand_in_pairs) {
  Lanes first{}, second{};
  for (int lane = 0; lane < lane_count; ++lane) first[lane] = lane + 0.5, second[lane] = -2.0 * lane;
  const auto [one, other] = unpack(pack(first, second));
  for (int lane = 0; lane < lane_count; ++lane) {
    EXPECT_EQ(one[lane], first[lane]);
    EXPECT_EQ(other[lane], second[lane]);
  }
}

TEST(lane_records, single_numbers_are_rounded_to_the_nearest) {
  Lanes numbers;
  for (int lane = 0; lane < lane_count; ++lane) numbers[lane] = 0.1 * (lane - 2);
  const FloatLanes rounded = single(numbers);
  for (int lane = 0; lane < lane_count; ++lane) EXPECT_EQ(rounded[lane], static_cast<float>(numbers[lane]));
}

TEST(lane_records, quads_that_are_worked_on_first_become_the_same_lanes) {
  auto all = records();
  const auto from = pointers(all);
  const auto twice = lanes_of_quads([&](std::size_t lane) { return 2 * load_half(&from[lane]->number[3]); });
  const auto once = load_quad(from, 3);
  for (std::size_t i = 0; i < 4; ++i)
    for (int lane = 0; lane < lane_count; ++lane) EXPECT_EQ(twice[i][lane], 2 * once[i][lane]);
}

TEST(lane_records, pairs_of_records_have_their_differences_and_both) {
  auto all = records();
  const auto from = pointers(all);
  const auto first = [&](std::size_t lane) { return &from[lane]->number[1]; };
  const auto second = [&](std::size_t lane) { return &all[lane].number[2]; };
  const PairsOfRecords pairs = load_pairs(first, second);
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    for (std::size_t i = 0; i < 8; ++i) {
      const auto n = static_cast<int>(lane);
      EXPECT_EQ(pairs.first[i][n], first(lane)[i]);
      EXPECT_EQ(pairs.second[i][n], second(lane)[i]);
      EXPECT_EQ(pairs.difference[i][n], second(lane)[i] - first(lane)[i]);
    }
}

TEST(lane_records, eight_numbers_of_each_lane_become_a_record) {
  std::array<Lanes, 8> fields;
  for (std::size_t i = 0; i < 8; ++i)
    for (int lane = 0; lane < lane_count; ++lane) fields[i][lane] = 10 * lane + static_cast<Real>(i);
  const auto octets = octets_of(fields);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    std::array<Real, 8> record;
    octets[lane].store(record.data());
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(record[i], static_cast<Real>(10 * lane + i));
  }
}

}  // namespace
}  // namespace sazare
