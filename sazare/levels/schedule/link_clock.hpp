#pragma once

/// When the links of a term are due, and for how long their forces act.
///
/// A link joins two bodies (or one body and the outside) and has the finer of their levels: it is due whenever
/// either of them is. A force evaluated at t acts until the middle of the link's coming interval: with equal steps that
/// is the leapfrog kick (half a step at the beginning, whole steps afterwards), and across a change of level the
/// windows still join without gap or overlap. [Konno2018], 3.1 takes force x time since the last evaluation instead,
/// which agrees for equal steps and is of first order where levels change.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/links.hpp"
#include "sazare/levels/schedule/levels.hpp"

namespace sazare::schedule {

class LinkClock {
public:
  void add(Index link, int level, Tick now);
  void remove(Index link);
  void set_level(Index link, int level);
  int level(Index link) const { return buckets_.level(link); }
  bool holds(Index link) const { return buckets_.holds(link); }
  std::size_t size() const { return buckets_.size(); }
  void sort() { buckets_.sort(); }
  /// Forces act from `now` on, as if none had acted before.
  void restart(Tick now) { std::ranges::fill(given_, now); }

  /// The links due at `now`, level by level, each with the time that its force acts, which is marked as given. The list stands
  /// until the next call.
  std::span<Due> collect(const Instant& now);

  void columns(Archive& archive);

private:
  void give(std::span<const Index> links, int level, Instant now, Due* due);

  Buckets buckets_;
  std::vector<Tick> given_;  ///< until when the link's force has acted
  std::vector<Due> due_;     ///< room for those that are due: lists that shrink and grow would be cleared each time
};

}  // namespace sazare::schedule
