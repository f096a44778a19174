#pragma once

/// Time levels: something at level k acts every base step / 2^k. Knows no physics.

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "sazare/core/time.hpp"

namespace sazare::schedule {

/// Deepest level there is; the half of its step is still a whole tick.
inline constexpr int deepest_level = 24;
inline constexpr int level_count = deepest_level + 1;
inline constexpr Tick base_stride = Tick{1} << (deepest_level + 1);

constexpr Tick stride(int level) { return base_stride >> level; }

/// Coarsest level that is due at a tick; all finer ones are due as well.
constexpr int coarsest_due(Tick tick) {
  if (tick == 0) return 0;
  const int in_phase = std::countr_zero(static_cast<std::uint64_t>(tick));
  const int level = deepest_level + 1 - in_phase;
  return level > 0 ? level : 0;
}

constexpr bool due_at(int level, Tick tick) { return tick % stride(level) == 0; }

/// Coarsest level whose steps fit a time.
int level_for(Real step_seconds, Real base_seconds);

/// Numbered items sorted into levels, so that what is due is found without looking at what is not.
class Buckets {
public:
  static constexpr int absent = -1;

  void insert(Index item, int level);
  void erase(Index item);
  void move(Index item, int level);

  int level(Index item) const { return level_[static_cast<std::size_t>(item)]; }
  bool holds(Index item) const { return item < static_cast<Index>(level_.size()) && level(item) != absent; }
  std::span<const Index> at(int level) const { return members_[static_cast<std::size_t>(level)]; }
  std::size_t size() const { return size_; }

  /// Makes a list of the items of a level and of all finer ones. Many come in rising order, whatever their levels: what
  /// neighbours share is then read from memory once.
  void list_from(int level, std::vector<Index>& items) const;

  /// Finest level in use, or `absent` when empty.
  int finest() const { return std::bit_width(used_) - 1; }

  /// Calls visit(level) for the levels in use from one on, the coarsest first.
  template <class Visit>
  void visit_from(int level, Visit&& visit) const {
    for (std::uint32_t left = used_ >> level << level; left != 0; left &= left - 1) visit(std::countr_zero(left));
  }

  /// Puts every level's items in rising order: neighbours in memory are then visited together. Looks at all items once.
  void sort();

  /// Levels by item, for checkpoints; the buckets are rebuilt from them in rising order.
  const std::vector<std::int8_t>& levels() const { return level_; }
  void assign(std::vector<std::int8_t> levels);

private:
  std::array<std::vector<Index>, level_count> members_;
  std::array<bool, level_count> unsorted_{};
  std::uint32_t used_ = 0;  ///< a bit for each level that has members
  std::vector<std::int8_t> level_;
  std::vector<Index> place_;  ///< where in its level an item stands
  std::size_t size_ = 0;
};

}  // namespace sazare::schedule
