#include "sazare/core/lane_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace sazare {
namespace {

std::vector<std::uint32_t> by_hand(float limit, const std::vector<float>& numbers, std::uint32_t offset) {
  std::vector<std::uint32_t> chosen;
  for (std::size_t n = 0; n < numbers.size(); ++n)
    if (numbers[n] <= limit) chosen.push_back(offset + static_cast<std::uint32_t>(n));
  return chosen;
}

TEST(lane_choice, takes_what_is_not_above_the_limit_in_order_for_any_count) {
  const float limit = 0.25F;
  for (std::size_t size = 0; size <= 50; ++size) {
    std::vector<float> numbers(size);
    for (std::size_t n = 0; n < size; ++n) numbers[n] = std::sin(3.7F * static_cast<float>(n * n));
    if (size > 3) {
      numbers[1] = limit;
      numbers[2] = std::numeric_limits<float>::quiet_NaN();
      numbers[3] = std::numeric_limits<float>::infinity();
    }
    std::vector<std::uint32_t> chosen(size + choice_spare, 77);
    const std::size_t count = choose_up_to(limit, numbers, 1000, chosen);
    chosen.resize(count);
    EXPECT_EQ(chosen, by_hand(limit, numbers, 1000)) << size;
  }
}

TEST(lane_choice, leaves_alone_what_stands_behind_its_room) {
  const std::vector<float> numbers(33, 0.0F);
  std::vector<std::uint32_t> chosen(33 + choice_spare + 1, 77);
  EXPECT_EQ(choose_up_to(1, numbers, 0, std::span(chosen).first(33 + choice_spare)), 33u);
  EXPECT_EQ(chosen.back(), 77u);
}

}  // namespace
}  // namespace sazare
