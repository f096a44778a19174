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
#include "sazare/schedule/levels.hpp"

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

  /// Appends those of the links due at `now` that are wanted, each with the time that its force acts, and marks that time as
  /// given for all of them. Returns how many are due.
  template <class Wanted>
  std::int64_t collect(const Moment& now, const Wanted& wanted, std::vector<Due>& due) {
    const int coarsest = coarsest_due(now.tick);
    std::size_t count = 0;
    for (int level = coarsest; level <= deepest_level; ++level) count += buckets_.at(level).size();
    std::size_t next = due.size();
    due.resize(next + count);  // at once: growing by and by would leave holes in memory as large as the list
    for (int level = coarsest; level <= deepest_level; ++level) {
      const Tick middle = now.tick + stride(level) / 2;
      for (const Index link : buckets_.at(level)) {
        Tick& given = given_[static_cast<std::size_t>(link)];
        const Tick before = given;
        given = std::max(before, middle);
        if (wanted(link))
          due[next++] = {link, static_cast<Real>(given - before) * now.tick_seconds,
                         static_cast<Real>(given - now.tick) * now.tick_seconds};
      }
    }
    due.resize(next);
    return static_cast<std::int64_t>(count);
  }
  std::int64_t collect(const Moment& now, std::vector<Due>& due) {
    return collect(
        now, [](Index) { return true; }, due);
  }

  void columns(Archive& archive);

private:
  Buckets buckets_;
  std::vector<Tick> given_;  ///< until when the link's force has acted
};

}  // namespace sazare::schedule
