#pragma once

/// The slots of a term and whose they are: the loops that every term shares.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sazare/core/coming_lines.hpp"
#include "sazare/levels/terms/events.hpp"
#include "sazare/levels/terms/force_moment.hpp"
#include "sazare/levels/terms/slot.hpp"
#include "sazare/levels/terms/term.hpp"

namespace sazare::terms {

/// One side of one slot, in four bytes.
struct SlotSide {
  Index slot : 31 = 0;
  std::uint32_t side : 1 = 0;
};

/// Sides by body, for links that are known at the beginning: those where it is the second body, then those where it is the
/// first, each in the order of the links.
class FixedIncidence {
public:
  FixedIncidence() = default;
  FixedIncidence(Index bodies, std::span<const Link> links) : ranges_(static_cast<std::size_t>(bodies)) {
    const auto each_side = [&](auto&& visit) {
      for (std::size_t link = 0; link < links.size(); ++link)
        if (links[link].second != Link::outside) visit(links[link].second, SlotSide{static_cast<Index>(link), 1});
      for (std::size_t link = 0; link < links.size(); ++link) visit(links[link].first, SlotSide{static_cast<Index>(link), 0});
    };
    each_side([&](Index body, SlotSide) { ++range(body).end; });
    std::uint32_t count = 0;
    for (Range& of : ranges_) {
      of.begin = count;
      count += std::exchange(of.end, count);
    }
    sides_.resize(count);
    each_side([&](Index body, SlotSide side) { sides_[range(body).end++] = side; });
  }

  std::span<const SlotSide> of(Index body) const {
    const Range& range = ranges_[static_cast<std::size_t>(body)];
    return {sides_.data() + range.begin, sides_.data() + range.end};
  }

  /// Leaves out a link that has no force any more: bodies around broken joints are often those that are kicked most.
  void end(Index slot, const Link& link) {
    for (const Index body : {link.first, link.second}) {
      if (body == Link::outside) continue;
      const auto sides = std::span(sides_).subspan(range(body).begin, of(body).size());
      const auto rest = std::ranges::remove(sides, slot, [](const SlotSide& side) { return Index{side.slot}; });
      range(body).end -= static_cast<std::uint32_t>(rest.size());
    }
  }

private:
  struct Range {
    std::uint32_t begin = 0, end = 0;
  };

  Range& range(Index body) { return ranges_[static_cast<std::size_t>(body)]; }

  std::vector<Range> ranges_;
  std::vector<SlotSide> sides_;
};

/// Sides by body, for links that come and go; the owner keeps each list in a fixed order, second sides first (by partner,
/// where every link's first body is the one with the smaller number).
class ChangingIncidence {
public:
  ChangingIncidence() = default;
  explicit ChangingIncidence(Index bodies) : lists_(static_cast<std::size_t>(bodies)) {}

  std::span<const SlotSide> of(Index body) const {
    const auto& list = lists_[static_cast<std::size_t>(body)];
    return list ? std::span<const SlotSide>(*list) : std::span<const SlotSide>();
  }
  std::vector<SlotSide>& list(Index body) {
    auto& list = lists_[static_cast<std::size_t>(body)];
    if (!list) list = std::make_unique<std::vector<SlotSide>>();
    return *list;
  }

private:
  std::vector<std::unique_ptr<std::vector<SlotSide>>> lists_;  ///< none where a body never had a link: most never have
};

/// Sums over the slots of a body.
template <int D, int Parts>
struct SlotSums {
  using Sum = ForceMoment<D>;

  Sum given, lead;
  std::array<Sum, Parts> part;

  // What is read beyond the last moment lies within the slot too.
  static_assert(Sum::width * sizeof(Real) <= sizeof(Slot<D, Parts>));

  /// All in registers and without branches: at a mix of levels no processor guesses which slots are new, nor on which side of
  /// each a body is. Compared in registers, for single numbers compilers branch.
  void add(const Slot<D, Parts>& slot, int side, Real now, Real tick_seconds, Real until_next) {
    constexpr auto two = &RegisterOf<2>::broadcast;
    const auto all = [](const RegisterOf<2>::Reals& number) { return Sum::Register::broadcast(number); };
    static constexpr std::array<Real, 2> signs = {-1, 1};
    const auto sign = two(signs[static_cast<std::size_t>(side)]), none = two(0);
    const Sum acts = Sum::load_once(slot.total.linear.data()), acted = Sum::load(slot.previous.linear.data());
    const auto acting = all(sign * (two(slot.evaluated) == two(now) ? two(slot.acting) : none));
    given.add(acting, acts);
    // Below 0: given beyond it; else predicted with the mean of both.
    const auto open = two(until_next - slot.ahead + (now - slot.evaluated) * tick_seconds);
    const auto half = two(0.5) * (open > none ? open : none);
    lead.add(all(sign * half), acted);
    lead.add(all(sign * (open - half)), acts);
    for (std::size_t p = 0; p < Parts; ++p) part[p].add(acting, Sum::load(slot.part[p].linear.data()));
  }
};

/// The slots of a term; the work of each part of the force is added to its cause, or that of the whole force where it has none.
template <int D, int Parts, class Incidence>
struct SlotTable {
  static constexpr std::size_t part_count = Parts == 0 ? 1 : Parts;

  std::array<Cause, part_count> causes{};
  std::vector<Slot<D, Parts>> slots;
  Incidence incidence;

  Slot<D, Parts>& operator[](Index slot) { return slots[static_cast<std::size_t>(slot)]; }
  const Slot<D, Parts>& operator[](Index slot) const { return slots[static_cast<std::size_t>(slot)]; }

  /// Adds the slots of one body, which stands at a place of a chunk: those evaluated now give their impulses.
  void gather_one(const Instant& now, Index body, std::size_t place, Impulse<D>& sum, CauseImpulses<D>& parts) const {
    const auto sides = incidence.of(body);
    if (sides.empty()) return;
    SlotSums<D, Parts> sums;
    const auto tick = static_cast<Real>(now.tick);
    for (const SlotSide side : sides)
      sums.add((*this)[side.slot], static_cast<int>(side.side), tick, now.tick_seconds, sum.until_next);
    sums.given.add_to(sum.linear.data());
    sums.lead.add_to(sum.linear_lead.data());
    if constexpr (Parts == 0)
      parts.add(causes[0], place, sums.given);
    else
      for (std::size_t p = 0; p < Parts; ++p) parts.add(causes[p], place, sums.part[p]);
  }

  void gather(const Instant& now, std::span<const Index> which, std::span<Impulse<D>> sum, CauseImpulses<D>& parts) const {
    if (is_large(slots))
      for (const Index body : which)
        for (const SlotSide side : incidence.of(body)) ask_for((*this)[side.slot]);
    for (std::size_t i = 0; i < which.size(); ++i) gather_one(now, which[i], i, sum[i], parts);
  }

  /// Work that the parts of a link's force will have done after now: the kicks at now had it in them [J].
  std::array<Real, part_count> work_after(Index slot, const Link& link, const Synchronized<D>& at) const {
    const auto& of = (*this)[slot];
    const auto work = [&](const auto& force) {
      Real power = -force.power(at.ahead[static_cast<std::size_t>(link.first)]);
      if (link.second != Link::outside) power += force.power(at.ahead[static_cast<std::size_t>(link.second)]);
      return of.ahead * power;
    };
    std::array<Real, part_count> works;
    if constexpr (Parts == 0)
      works[0] = work(of.total);
    else
      for (std::size_t p = 0; p < Parts; ++p) works[p] = work(of.part[p]);
    return works;
  }

  /// Subtracts that work from the sums.
  void take_back(const std::array<Real, part_count>& work, EnergySums& energies) const {
    for (std::size_t p = 0; p < part_count; ++p) add_work(causes[p], -work[p], energies);
  }
  void take_back(Index slot, const Link& link, const Synchronized<D>& at, EnergySums& energies) const {
    take_back(work_after(slot, link, at), energies);
  }
};

}  // namespace sazare::terms
