#pragma once

/// Contiguous ranges of bodies, one for each rank: whoever owns a body kicks it, and evaluates all its links.

#include <span>
#include <vector>

#include "sazare/core/time.hpp"

namespace sazare::distribute {

class Ranges {
public:
  /// Everything to the first of one rank.
  Ranges() = default;
  /// `begin` by rank, and the end: rising from 0 to the number of bodies.
  explicit Ranges(std::vector<Index> begin);

  int count() const { return static_cast<int>(begin_.size()) - 1; }
  int owner(Index body) const { return owner_[static_cast<std::size_t>(body)]; }
  Index begin(int rank) const { return begin_[static_cast<std::size_t>(rank)]; }
  Index end(int rank) const { return begin_[static_cast<std::size_t>(rank) + 1]; }
  Index size(int rank) const { return end(rank) - begin(rank); }
  std::span<const Index> cuts() const { return begin_; }

  friend bool operator==(const Ranges& one, const Ranges& other) { return one.begin_ == other.begin_; }

private:
  std::vector<Index> begin_ = {0, 0};
  std::vector<int> owner_;  ///< by body
};

/// Ranges of the same cost, as nearly as whole bodies allow. No range is empty where there are as many bodies as ranks.
Ranges cut_evenly(std::span<const Real> cost, int ranks);

}  // namespace sazare::distribute
