#pragma once

/// Forces of links on the strains of their bodies (state/strain.hpp), beside their slots: which interval a force is given for,
/// and whether it is new, the slot says (slot.hpp).

#include <array>
#include <span>
#include <vector>

#include "sazare/levels/terms/slot.hpp"
#include "sazare/levels/terms/work.hpp"
#include "sazare/state/strain.hpp"

namespace sazare::terms {

/// What the strain of one body gathers from all terms.
struct StrainGathered {
  state::StrainImpulse impulse;
  Real until_next = 0;                         ///< asked for: time from now to the body's next one [s]
  std::array<Vector6, cause_count> part = {};  ///< of the impulse, by cause
  std::array<bool, cause_count> has_part = {};

  void add_part(Cause cause, Real acting, const Vector6& force) {
    const auto c = static_cast<std::size_t>(cause);
    if (!has_part[c]) part[c].setZero();
    has_part[c] = true;
    part[c] += acting * force;
  }
};

/// Forces on the strains of the first and, of two sides, of the second body of a link [N m]: each its own, since each has its own
/// frame.
template <int Sides>
struct alignas(64) StrainForces {
  static constexpr std::size_t size = 6 * Sides;

  std::array<Real, size> total = {};
  std::array<float, size> part = {};      ///< whose work is summed apart
  std::array<float, size> previous = {};  ///< the total before the last evaluation

  Vector6 total_on(int side) const { return six(total, side); }
  Vector6 part_on(int side) const { return six(part, side); }
  Vector6 previous_on(int side) const { return six(previous, side); }

  /// Enters a new evaluation; to be called before the slot of the link is written.
  template <class Numbers>
  void write(bool is_first, const Numbers& now, const Numbers& part_now) {
    for (std::size_t i = 0; i < size; ++i) {
      const auto n = static_cast<Eigen::Index>(i);
      previous[i] = static_cast<float>(is_first ? now[n] : total[i]);
      total[i] = now[n];
      part[i] = static_cast<float>(part_now[n]);
    }
  }

private:
  template <class Number>
  static Vector6 six(const std::array<Number, size>& numbers, int side) {
    return Eigen::Map<const Eigen::Matrix<Number, 6, 1>>(numbers.data() + 6 * side).template cast<Real>();
  }
};
static_assert(sizeof(StrainForces<2>) == 24 * sizeof(Real));

/// What a force gives to a body, see SlotSums; when, `slot` says.
template <class Slot, int Sides>
void add_strain_force(const Instant& now, const Slot& slot, const StrainForces<Sides>& forces, int side, Cause cause,
                      bool all_is_part, StrainGathered& sum) {
  const auto tick = static_cast<Real>(now.tick);
  const Real open = sum.until_next - slot.ahead + (tick - slot.evaluated) * now.tick_seconds, half = 0.5 * (open > 0 ? open : 0);
  const Vector6 total = forces.total_on(side);
  sum.impulse.lead += half * forces.previous_on(side) + (open - half) * total;
  if (slot.evaluated != tick) return;
  sum.impulse.given += slot.acting * total;
  sum.add_part(cause, slot.acting, all_is_part ? total : forces.part_on(side));
}

/// The forces on strains of all links of a term, link by link as its slots.
template <int Sides>
struct StrainTable {
  std::vector<StrainForces<Sides>> forces;  ///< none where all bodies are rigid

  StrainForces<Sides>& operator[](Index link) { return forces[static_cast<std::size_t>(link)]; }
  const StrainForces<Sides>& operator[](Index link) const { return forces[static_cast<std::size_t>(link)]; }

  /// Adds what one body receives; `table` has the slots of the links.
  template <class Table>
  void gather(const Instant& now, Index body, const Table& table, StrainGathered& sum) const {
    for (const auto side : table.incidence.of(body)) {
      const auto& slot = table[side.slot];
      add_strain_force(now, slot, (*this)[side.slot], Sides == 2 ? static_cast<int>(side.side) : 0, table.causes[0],
                       slot.part.empty(), sum);
    }
  }

  /// Work that the part of a link's force will have done on strains after now, see SlotTable::work_after [J].
  template <class Table>
  Real work_after(Index link, const Link& bodies, const Table& table, std::span<const state::StrainNow> strain) const {
    const auto& slot = table[link];
    const StrainForces<Sides>& of = (*this)[link];
    const auto power = [&](Index body, int side) {
      if (body == Link::outside) return Real{0};
      return (slot.part.empty() ? of.total_on(side) : of.part_on(side)).dot(strain[static_cast<std::size_t>(body)].ahead);
    };
    return slot.ahead * (power(bodies.first, 0) + (Sides == 2 ? power(bodies.second, 1) : 0));
  }

  /// Subtracts that work from the sums; there is none where all bodies are rigid.
  template <class Table, class Synchronized>
  void take_back(Index link, const Link& bodies, const Table& table, const Synchronized& now, EnergySums& energies) const {
    if (!forces.empty()) add_work(table.causes[0], -work_after(link, bodies, table, now.strain), energies);
  }
};

}  // namespace sazare::terms
