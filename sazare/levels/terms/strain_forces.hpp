#pragma once

/// Forces of links on the strains of their bodies (state/strain.hpp), beside their slots: which interval a force is given for,
/// and whether it is new, the slot says (slot.hpp).

#include <array>
#include <span>
#include <vector>

#include "sazare/core/archive.hpp"
#include "sazare/core/large_tables.hpp"
#include "sazare/core/parcel.hpp"
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
/// frame. `Parts` are those of the slot of the link.
template <int Sides, int Parts>
struct alignas(64) StrainForces {
  static constexpr std::size_t size = 6 * Sides;
  using Numbers = Eigen::Matrix<Real, 6 * Sides, 1, Eigen::DontAlign>;

  std::array<Real, size> total = {};
  std::array<std::array<float, size>, Parts> part = {};  ///< whose work is summed apart
  std::array<float, size> previous = {};                 ///< the total before the last evaluation

  Vector6 total_on(int side) const { return six(total, side); }
  Vector6 part_on(int side, std::size_t p) const { return six(part[p], side); }
  Vector6 previous_on(int side) const { return six(previous, side); }

  /// Enters a new evaluation; to be called before the slot of the link is written.
  void write(bool is_first, const Numbers& now, const std::array<Numbers, Parts>& part_now) {
    for (std::size_t i = 0; i < size; ++i) {
      const auto n = static_cast<Eigen::Index>(i);
      previous[i] = static_cast<float>(is_first ? now[n] : total[i]);
      total[i] = now[n];
      for (std::size_t p = 0; p < Parts; ++p) part[p][i] = static_cast<float>(part_now[p][n]);
    }
  }

private:
  template <class Number>
  static Vector6 six(const std::array<Number, size>& numbers, int side) {
    return Eigen::Map<const Eigen::Matrix<Number, 6, 1>>(numbers.data() + 6 * side).template cast<Real>();
  }
};
static_assert(sizeof(StrainForces<2, 1>) == 24 * sizeof(Real));

/// What a force gives to a body, see SlotSums; when, `slot` says.
template <class Slot, int Sides, int Parts, std::size_t Causes>
void add_strain_force(const Instant& now, const Slot& slot, const StrainForces<Sides, Parts>& forces, int side,
                      const std::array<Cause, Causes>& causes, StrainGathered& sum) {
  static_assert(Causes == (Parts == 0 ? 1 : Parts));
  const auto tick = static_cast<Real>(now.tick);
  const Real open = sum.until_next - slot.ahead + (tick - slot.evaluated) * now.tick_seconds, half = 0.5 * (open > 0 ? open : 0);
  const Vector6 total = forces.total_on(side);
  sum.impulse.lead += half * forces.previous_on(side) + (open - half) * total;
  if (slot.evaluated != tick) return;
  sum.impulse.given += slot.acting * total;
  if constexpr (Parts == 0)
    sum.add_part(causes[0], slot.acting, total);
  else
    for (std::size_t p = 0; p < Parts; ++p) sum.add_part(causes[p], slot.acting, forces.part_on(side, p));
}

/// The forces on strains of all links of a term, link by link as its slots.
template <int Sides, int Parts>
struct StrainTable {
  using Forces = StrainForces<Sides, Parts>;
  static constexpr std::size_t part_count = Parts == 0 ? 1 : Parts;

  bool exists = false;         ///< false where all bodies are rigid
  std::vector<Forces> forces;  ///< none then

  StrainTable() = default;
  /// For so many links at the beginning.
  StrainTable(const state::Bodies<3>& bodies, std::size_t links) : exists(!bodies.strain.empty()) {
    reserve_on_large_pages(forces, exists ? links : 0);
    forces.resize(exists ? links : 0);
  }

  Forces& operator[](Index link) { return forces[static_cast<std::size_t>(link)]; }
  const Forces& operator[](Index link) const { return forces[static_cast<std::size_t>(link)]; }

  /// A link that is new, whose number is the next one or that of one that has ended.
  void begin(Index link) {
    if (!exists) return;
    if (forces.size() <= static_cast<std::size_t>(link)) forces.resize(static_cast<std::size_t>(link) + 1);
    (*this)[link] = {};
  }
  /// A link has no force any more.
  void clear(Index link) {
    if (exists) (*this)[link] = {};
  }

  /// Adds what one body receives; `table` has the slots of the links.
  template <class Table>
  void gather(const Instant& now, Index body, const Table& table, StrainGathered& sum) const {
    for (const auto side : table.incidence.of(body))
      add_strain_force(now, table[side.slot], (*this)[side.slot], Sides == 2 ? static_cast<int>(side.side) : 0, table.causes,
                       sum);
  }

  /// Work that the parts of a link's force will have done on strains after now, see SlotTable::work_after [J].
  template <class Table>
  std::array<Real, part_count> work_after(Index link, const Link& bodies, const Table& table,
                                          std::span<const state::StrainNow> strain) const {
    const Forces& of = (*this)[link];
    const auto power = [&](std::size_t part, Index body, int side) {
      if (body == Link::outside) return Real{0};
      const Vector6& ahead = strain[static_cast<std::size_t>(body)].ahead;
      if constexpr (Parts == 0)
        return of.total_on(side).dot(ahead);
      else
        return of.part_on(side, part).dot(ahead);
    };
    std::array<Real, part_count> works;
    for (std::size_t p = 0; p < part_count; ++p)
      works[p] = table[link].ahead * (power(p, bodies.first, 0) + (Sides == 2 ? power(p, bodies.second, 1) : 0));
    return works;
  }

  /// Subtracts that work from the sums.
  template <class Table, class Synchronized>
  void take_back(Index link, const Link& bodies, const Table& table, const Synchronized& now, EnergySums& energies) const {
    if (exists) table.take_back(work_after(link, bodies, table, now.strain), energies);
  }

  void carry(Index link, Parcel& parcel) {
    if (exists) parcel((*this)[link]);
  }
  void columns(Archive& archive) {
    if (exists) archive("strain_forces", forces);
  }
};

}  // namespace sazare::terms
