#pragma once

/// Numbers in lanes added to an exact sum, in a few instructions for all of them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sazare/core/exact_sum.hpp"
#include "sazare/core/lanes.hpp"

namespace sazare {

/// Each number is cut into whole multiples of 2^-18, 2^-66, 2^-114 and 2^-162, which lanes count: added to 1.5 2^52 of such a
/// unit it is rounded to its multiples, and the last bits of the sum are their count. What is larger than a count has room for,
/// or has digits below the last unit, goes to the exact sum number by number. All that was added is there at the end of life.
class LaneSum {
public:
  explicit LaneSum(ExactSum& sum) : sum_(&sum) {}
  ~LaneSum() { settle(); }
  LaneSum(const LaneSum&) = delete;
  LaneSum& operator=(const LaneSum&) = delete;

  LaneSum& operator+=(const Lanes& numbers) {
    const Lanes size = numbers < 0.0 ? -numbers : numbers;
    if (!all_above(broadcast(largest), size)) {
      add_one_by_one(numbers);
      return *this;
    }
    Lanes rest = numbers;
    for (std::size_t i = 0; i < units.size(); ++i) {
      const Lanes offset = broadcast(units[i].offset), rounded = rest + offset;
      counts_[i] += reinterpret_cast<LongLanes>(rounded) - reinterpret_cast<LongLanes>(offset);
      rest -= rounded - offset;
    }
    if (any(rest != 0.0)) add_one_by_one(rest);
    if (++additions_ == most_additions) settle();
    return *this;
  }
  LaneSum& operator-=(const Lanes& numbers) { return *this += -numbers; }

private:
  struct Unit {
    int exponent;
    Real offset;  ///< 1.5 2^52 units
  };

  static constexpr std::array<Unit, 4> units = {Unit{-18, 0x1.8p34}, {-66, 0x1.8p-14}, {-114, 0x1.8p-62}, {-162, 0x1.8p-110}};
  static constexpr Real largest = 0x1p33;     // 2^51 of the first unit
  static constexpr int most_additions = 256;  // of counts up to 2^51 in eight lanes

  void add_one_by_one(const Lanes& numbers) {
    for (int lane = 0; lane < lane_count; ++lane) *sum_ += numbers[lane];
  }

  void settle() {
    if (additions_ == 0) return;
    for (std::size_t i = 0; i < units.size(); ++i) {
      std::int64_t count = 0;
      for (int lane = 0; lane < lane_count; ++lane) count += counts_[i][lane];
      sum_->add_multiple(count, units[i].exponent);
      counts_[i] = LongLanes{};
    }
    additions_ = 0;
  }

  ExactSum* sum_;
  std::array<LongLanes, units.size()> counts_{};
  int additions_ = 0;
};

/// Loads as many numbers as there are lanes, or fewer and zeros.
inline Lanes load_some(std::span<const Real> numbers) {
  if (numbers.size() >= lane_count) return load_lanes(numbers.data());
  Lanes lanes{};
  for (std::size_t lane = 0; lane < numbers.size(); ++lane) lanes[static_cast<int>(lane)] = numbers[lane];
  return lanes;
}

inline void add_all(std::span<const Real> numbers, ExactSum& sum) {
  LaneSum lanes(sum);
  for (std::size_t first = 0; first < numbers.size(); first += lane_count) lanes += load_some(numbers.subspan(first));
}

}  // namespace sazare
