#pragma once

/// Which rank works for which bodies: whoever owns a body kicks it, and evaluates all its links.

#include <span>
#include <vector>

#include "sazare/core/time.hpp"

namespace sazare::distribute {

/// Bodies that follow each other in memory.
struct BodyRange {
  Index begin = 0;
  Index end = 0;

  friend bool operator==(const BodyRange&, const BodyRange&) = default;
};

class Owners {
public:
  /// No bodies, and one rank.
  Owners() : Owners({}, 1) {}
  /// The owner of each body, and how many ranks there are.
  Owners(std::vector<int> owner, int ranks);

  int ranks() const { return static_cast<int>(ranges_.size()); }
  Index bodies() const { return static_cast<Index>(owner_.size()); }
  int owner(Index body) const { return owner_[static_cast<std::size_t>(body)]; }

  /// All bodies of a rank, rising, and how many they are.
  std::span<const BodyRange> ranges(int rank) const { return ranges_[static_cast<std::size_t>(rank)]; }
  Index size(int rank) const;

  friend bool operator==(const Owners& one, const Owners& other) { return one.owner_ == other.owner_; }

private:
  std::vector<int> owner_;                      ///< by body
  std::vector<std::vector<BodyRange>> ranges_;  ///< by rank
};

/// One range of bodies for each rank, of the same cost as nearly as whole bodies allow. No range is empty where there are as
/// many bodies as ranks.
Owners cut_evenly(std::span<const Real> cost, int ranks);

/// As many bodies for each rank.
Owners cut_equally(Index bodies, int ranks);

}  // namespace sazare::distribute
