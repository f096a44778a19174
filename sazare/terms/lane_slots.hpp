#pragma once

/// Slots of several links, one in each lane.

#include <array>

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

/// What `write` does for one slot, four doubles at a time: a total and one part of it. Where lanes have the same slot they must
/// have the same force. A link that begins anew has no force before this one.
inline void write(const LanePointers<Slot<3, 1>>& slots, const Moment& now, const LaneDue& due, const LanePairForce& total,
                  const LanePairForce& part, const LaneMask& begins_anew = LaneMask{}) {
  static_assert(sizeof(Slot<3, 1>) == 24 * sizeof(Real));
  Lanes acting{}, ahead{};
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    acting[static_cast<int>(lane)] = due[lane].acting;
    ahead[static_cast<int>(lane)] = due[lane].ahead;
  }
  const auto before = load_records<12>(slots);
  const LaneMask follows = ~begins_anew & (before[11] >= 0.0);  // it has been evaluated
  const auto mean = [&](const Lanes& earlier, const Lanes& force_now) {
    return 0.5 * (select(follows, earlier, force_now) + force_now);
  };
  const LaneVector &a = total.first_moment, &f = total.linear, &b = total.second_moment;
  const LaneVector &c = part.first_moment, &g = part.linear, &d = part.second_moment;
  const Lanes last_mean = mean(before[8], b[2]);
  store_quad({a[0], a[1], a[2], f[0]}, slots, 0);
  store_quad({f[1], f[2], b[0], b[1]}, slots, 4);
  store_quad({b[2], acting, ahead, broadcast(static_cast<Real>(now.tick))}, slots, 8);
  store_quad({pack(mean(before[0], a[0]), mean(before[1], a[1])), pack(mean(before[2], a[2]), mean(before[3], f[0])),
              pack(mean(before[4], f[1]), mean(before[5], f[2])), pack(mean(before[6], b[0]), mean(before[7], b[1]))},
             slots, 12);
  store_quad({pack(last_mean, c[0]), pack(c[1], c[2]), pack(g[0], g[1]), pack(g[2], d[0])}, slots, 16);
  store_quad({pack(d[1], d[2]), Lanes{}, Lanes{}, Lanes{}}, slots, 20);
}

/// Work that the part of each link's force will have done after now [J], see SlotTable::work_after; all links join two bodies.
inline Lanes work_after(const LanePointers<const Slot<3, 1>>& slots, const LanePointers<const MeanMotion<3>>& firsts,
                        const LanePointers<const MeanMotion<3>>& seconds) {
  const auto times = load_quad(slots, 8), early = load_quad(slots, 16), late = load_quad(slots, 20);
  const auto a = unpack(early[0]), b = unpack(early[1]), c = unpack(early[2]), d = unpack(early[3]), e = unpack(late[0]);
  const auto first = load_quad(firsts, 0), first_spin = load_quad(firsts, 4);
  const auto second = load_quad(seconds, 0), second_spin = load_quad(seconds, 4);
  const LaneVector first_moment{{a[1], b[0], b[1]}}, linear{{c[0], c[1], d[0]}}, second_moment{{d[1], e[0], e[1]}};
  const LaneVector opening{{second[0] - first[0], second[1] - first[1], second[2] - first[2]}};
  const Lanes power = dot(linear, opening) + dot(first_moment, {{first[3], first_spin[0], first_spin[1]}}) +
                      dot(second_moment, {{second[3], second_spin[0], second_spin[1]}});
  return times[2] * power;
}

}  // namespace sazare::terms
