#pragma once

/// The slots of a term and who waits for which: the loops that every term shares.

#include <algorithm>
#include <span>
#include <vector>

#include "sazare/terms/events.hpp"
#include "sazare/terms/slot.hpp"
#include "sazare/terms/term.hpp"

namespace sazare::terms {

/// One side of one slot.
struct SlotSide {
  Index slot = 0;
  Index side = 0;
};

/// Sides by body, for links that are known at the beginning; in the order of the links.
class FixedIncidence {
 public:
  FixedIncidence() = default;
  FixedIncidence(Index bodies, std::span<const Link> links) : begin_(static_cast<std::size_t>(bodies) + 1, 0) {
    const auto each_side = [&](auto&& visit) {
      for (std::size_t link = 0; link < links.size(); ++link) {
        visit(links[link].first, SlotSide{static_cast<Index>(link), 0});
        if (links[link].second != Link::outside) visit(links[link].second, SlotSide{static_cast<Index>(link), 1});
      }
    };
    each_side([&](Index body, SlotSide) { ++begin_[static_cast<std::size_t>(body) + 1]; });
    for (std::size_t body = 1; body < begin_.size(); ++body) begin_[body] += begin_[body - 1];
    sides_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    each_side([&](Index body, SlotSide side) { sides_[next[static_cast<std::size_t>(body)]++] = side; });
  }

  std::span<const SlotSide> of(Index body) const {
    const auto at = static_cast<std::size_t>(body);
    return std::span(sides_).subspan(begin_[at], begin_[at + 1] - begin_[at]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<SlotSide> sides_;
};

/// Sides by body, for links that come and go; the owner keeps each list in a fixed order (by partner).
class ChangingIncidence {
 public:
  ChangingIncidence() = default;
  explicit ChangingIncidence(Index bodies) : lists_(static_cast<std::size_t>(bodies)) {}

  std::span<const SlotSide> of(Index body) const { return lists_[static_cast<std::size_t>(body)]; }
  std::vector<SlotSide>& list(Index body) { return lists_[static_cast<std::size_t>(body)]; }

 private:
  std::vector<std::vector<SlotSide>> lists_;
};

template <int D, int Causes, class Incidence>
struct SlotTable {
  std::vector<Slot<D, Causes>> slots;
  Incidence incidence;

  Slot<D, Causes>& operator[](Index slot) { return slots[static_cast<std::size_t>(slot)]; }
  const Slot<D, Causes>& operator[](Index slot) const { return slots[static_cast<std::size_t>(slot)]; }

  void gather(const Moment& now, std::span<const Index> which, const state::Bodies<D>& bodies,
              std::span<Impulse<D>> sum) const {
    for (std::size_t i = 0; i < which.size(); ++i) {
      const auto& body = bodies.motion[static_cast<std::size_t>(which[i])];
      for (const SlotSide at : incidence.of(which[i])) terms::gather((*this)[at.slot], at.side, body, now, sum[i]);
    }
  }

  void book(std::span<const Index> which, std::span<const Tick> previous_kick, std::span<const MeanMotion<D>> mean) {
    for (std::size_t i = 0; i < which.size(); ++i)
      for (const SlotSide at : incidence.of(which[i]))
        terms::book((*this)[at.slot], at.side, previous_kick[i], mean[i]);
  }

  void gather_ahead(Tick now, std::span<Impulse<D>> sum) const {
    for (std::size_t body = 0; body < sum.size(); ++body)
      for (const SlotSide at : incidence.of(static_cast<Index>(body)))
        terms::gather_ahead((*this)[at.slot], at.side, now, sum[body]);
  }

  /// Work of a cause on the bodies of a link [J].
  Real work_until(Index slot, const Link& link, int cause, const Synchronized<D>& at) const {
    Real work = terms::work_until((*this)[slot], 0, cause, at.now, at.ahead[static_cast<std::size_t>(link.first)]);
    if (link.second != Link::outside)
      work += terms::work_until((*this)[slot], 1, cause, at.now, at.ahead[static_cast<std::size_t>(link.second)]);
    return work;
  }
};

}  // namespace sazare::terms
