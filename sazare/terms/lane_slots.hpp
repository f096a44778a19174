#pragma once

/// Slots of several links, one in each lane.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sazare/core/lane_records.hpp"
#include "sazare/terms/slot.hpp"

namespace sazare::terms {

/// A PairForce in every lane.
struct LanePairForce {
  LaneVector first_moment, linear, second_moment;
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
inline void keep_total(Slot<3, 1>& slot) {
  const Real* const from = slot.total.first_moment.data();
  float* const to = slot.previous.first_moment.data();
  for (int n = 0; n < 8; n += lane_count) *reinterpret_cast<LooseFloats*>(to + n) = single(load_lanes(from + n));
  to[8] = static_cast<float>(from[8]);
}

/// What `write` does for one slot: a total and one part of it. Where lanes have the same slot they must have the same force. A
/// link that begins anew has no force before this one.
inline void write(const LanePointers<Slot<3, 1>>& slots, const Moment& now, const LaneDue& due, const LanePairForce& total,
                  const LanePairForce& part, const LaneMask& begins_anew = LaneMask{}) {
  using LaneSlot = Slot<3, 1>;
  static_assert(sizeof(LaneSlot) == 24 * sizeof(Real) && offsetof(LaneSlot, part) == 12 * sizeof(Real));
  const LaneVector &a = total.first_moment, &f = total.linear, &b = total.second_moment;
  const LaneVector &c = part.first_moment, &g = part.linear, &d = part.second_moment;
  LaneBits begin = bits_of(begins_anew);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const auto sign = std::bit_cast<std::uint64_t>(slots[lane]->evaluated) >> 63;  // without a branch
    begin |= static_cast<LaneBits>(sign << lane);
    keep_total(*slots[lane]);
  }
  store_quad({a[0], a[1], a[2], f[0]}, slots, 0);
  store_quad({f[1], f[2], b[0], b[1]}, slots, 4);
  store_quad({pack(c[0], c[1]), pack(c[2], g[0]), pack(g[1], g[2]), pack(d[0], d[1])}, slots, 12);
  const FloatLanes last = single(d[2]);
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    Slot<3, 1>& slot = *slots[lane];
    slot.total.second_moment[2] = b[2][static_cast<int>(lane)];
    std::memcpy(&slot.acting, &due[lane].acting, 2 * sizeof(Real));
    slot.evaluated = static_cast<Real>(now.tick);
    slot.part[0].second_moment[2] = last[static_cast<int>(lane)];
  }
  for (; begin != 0; begin &= begin - 1) keep_total(*slots[static_cast<std::size_t>(std::countr_zero(begin))]);
}

/// Work that the part of each link's force will have done after now [J], see SlotTable::work_after; all links join two bodies.
inline Lanes work_after(const LanePointers<const Slot<3, 1>>& slots, const LanePointers<const MeanMotion<3>>& firsts,
                        const LanePointers<const MeanMotion<3>>& seconds) {
  const auto times = load_quad(slots, 8), early = load_quad(slots, 12), late = load_quad(slots, 16);
  const auto a = unpack(early[0]), b = unpack(early[1]), c = unpack(early[2]), d = unpack(early[3]), e = unpack(late[0]);
  const auto first = load_quad(firsts, 0), first_spin = load_quad(firsts, 4);
  const auto second = load_quad(seconds, 0), second_spin = load_quad(seconds, 4);
  const LaneVector first_moment{{a[0], a[1], b[0]}}, linear{{b[1], c[0], c[1]}}, second_moment{{d[0], d[1], e[0]}};
  const LaneVector opening{{second[0] - first[0], second[1] - first[1], second[2] - first[2]}};
  const Lanes power = dot(linear, opening) + dot(first_moment, {{first[3], first_spin[0], first_spin[1]}}) +
                      dot(second_moment, {{second[3], second_spin[0], second_spin[1]}});
  return times[2] * power;
}

}  // namespace sazare::terms
