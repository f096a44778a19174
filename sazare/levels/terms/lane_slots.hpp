#pragma once

/// Slots of several links, one in each lane.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sazare/core/lane_records.hpp"
#include "sazare/levels/terms/slot.hpp"

namespace sazare::terms {

/// A PairForce in every lane.
struct LanePairForce {
  LaneVector linear, moment;

  /// A force on the second body at a point, given from the pole.
  static LanePairForce at(const LaneVector& point, const LaneVector& force) { return {force, cross(point, force)}; }
};

/// Links that are due, one in each lane; idle lanes repeat the first. A copy: compilers gather where they choose between
/// addresses, which is slow.
using LaneDue = std::array<Due, lane_count>;

inline LaneDue in_lanes(std::span<const Due> due) {
  LaneDue lanes;
  for (std::size_t lane = 0; lane < lane_count; ++lane) lanes[lane] = due[lane < due.size() ? lane : 0];
  return lanes;
}

/// The last total of a slot becomes the one before; numbers go in a row from memory to memory, without being turned into lanes.
/// Two more are written behind it, where a part begins, which is to be written next.
template <int Parts>
void keep_total(Slot<3, Parts>& slot) {
  const Real* const from = slot.total.linear.data();
  float* const to = slot.previous.linear.data();
  for (int n = 0; n < 8; n += lane_count) *reinterpret_cast<LooseFloats*>(to + n) = single(load_lanes(from + n));
}

/// What `write` does for one slot, all but the parts. Where lanes have the same slot they must have the same force. A link that
/// begins anew has no force before this one.
template <int Parts>
void write_total(const LanePointers<Slot<3, Parts>>& slots, const Instant& now, const LaneDue& due, const LanePairForce& total,
                 const LaneMask& begins_anew) {
  using LaneSlot = Slot<3, Parts>;
  static_assert(sizeof(LaneSlot) == 16 * sizeof(Real) && offsetof(LaneSlot, evaluated) == 8 * sizeof(Real));
  const LaneVector &f = total.linear, &m = total.moment;
  LaneBits begin = bits_of(begins_anew);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const auto sign = std::bit_cast<std::uint64_t>(slots[lane]->evaluated) >> 63;  // without a branch
    begin |= static_cast<LaneBits>(sign << lane);
    keep_total(*slots[lane]);
  }
  store_quad({f[0], f[1], f[2], m[0]}, slots, 0);
  store_quad({m[1], m[2], Lanes{}, Lanes{}}, slots, 4);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    std::memcpy(&slots[lane]->acting, &due[lane].acting, 2 * sizeof(Real));
    slots[lane]->evaluated = static_cast<Real>(now.tick);
  }
  for (; begin != 0; begin &= begin - 1) {
    LaneSlot& slot = *slots[static_cast<std::size_t>(std::countr_zero(begin))];
    slot.previous = slot.total.template as<float>();
  }
}

inline void write(const LanePointers<Slot<3, 0>>& slots, const Instant& now, const LaneDue& due, const LanePairForce& total) {
  write_total(slots, now, due, total, LaneMask{});
}

inline void write(const LanePointers<Slot<3, 1>>& slots, const Instant& now, const LaneDue& due, const LanePairForce& total,
                  const LanePairForce& part, const LaneMask& begins_anew = LaneMask{}) {
  using LaneSlot = Slot<3, 1>;
  static_assert(offsetof(LaneSlot, part) == 12 * sizeof(Real));
  const LaneVector &g = part.linear, &n = part.moment;
  write_total(slots, now, due, total, begins_anew);
  store_quad({pack(g[0], g[1]), pack(g[2], n[0]), pack(n[1], n[2]), Lanes{}}, slots, 12);
}

/// Work that the part of each link's force will have done after now [J], see SlotTable::work_after; all links join two bodies.
inline Lanes work_after(const LanePointers<const Slot<3, 1>>& slots, const LanePointers<const MeanMotion<3>>& firsts,
                        const LanePointers<const MeanMotion<3>>& seconds) {
  const auto times = load_quad(slots, 4), numbers = load_quad(slots, 12);
  const auto a = unpack(numbers[0]), b = unpack(numbers[1]), c = unpack(numbers[2]);
  const auto first = load_quad(firsts, 0), first_spin = load_quad(firsts, 4);
  const auto second = load_quad(seconds, 0), second_spin = load_quad(seconds, 4);
  const LaneVector linear{{a[0], a[1], b[0]}}, moment{{b[1], c[0], c[1]}};
  const LaneVector opening{{second[0] - first[0], second[1] - first[1], second[2] - first[2]}};
  const LaneVector turning{{second[3] - first[3], second_spin[0] - first_spin[0], second_spin[1] - first_spin[1]}};
  return times[3] * (dot(linear, opening) + dot(moment, turning));
}

}  // namespace sazare::terms
