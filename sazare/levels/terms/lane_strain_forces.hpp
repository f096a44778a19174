#pragma once

/// Forces on the strains of both bodies of several links, one in each lane.

#include <bit>

#include "sazare/levels/terms/lane_slots.hpp"
#include "sazare/levels/terms/strain_forces.hpp"

namespace sazare::terms {

/// Six numbers of the first body and six of the second, in every lane.
using LaneStrainNumbers = std::array<Lanes, 12>;

/// The last total becomes the one before; numbers go in a row from memory to memory, without being turned into lanes.
inline void keep_total(StrainForces<2, 1>& forces) {
  for (const std::size_t begin : {std::size_t{0}, std::size_t{4}, std::size_t{12} - lane_count})  // rows that overlap
    *reinterpret_cast<LooseFloats*>(forces.previous.data() + begin) = single(load_lanes(forces.total.data() + begin));
}

/// What StrainForces::write does, before the slots of the links are written. Lanes of one link must have the same numbers.
template <class Slot>
void write(const LanePointers<StrainForces<2, 1>>& forces, const LanePointers<Slot>& slots, const LaneStrainNumbers& total,
           const LaneStrainNumbers& part, const LaneMask& begins_anew) {
  LaneBits begin = bits_of(begins_anew);
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    begin |= static_cast<LaneBits>((std::bit_cast<std::uint64_t>(slots[lane]->evaluated) >> 63) << lane);
  const auto packed = [&](std::size_t i) { return pack(part[2 * i], part[2 * i + 1]); };
  store_quad({packed(0), packed(1), packed(2), packed(3)}, forces, 12);
  store_quad({packed(4), packed(5), Lanes{}, Lanes{}}, forces, 16);  // and where the one before begins, which comes next
  for (std::size_t lane = 0; lane < lane_count; ++lane) keep_total(*forces[lane]);
  for (std::size_t i = 0; i < 12; i += 4) store_quad({total[i], total[i + 1], total[i + 2], total[i + 3]}, forces, i);
  for (; begin != 0; begin &= begin - 1) {
    StrainForces<2, 1>& anew = *forces[static_cast<std::size_t>(std::countr_zero(begin))];
    for (std::size_t i = 0; i < 12; ++i) anew.previous[i] = static_cast<float>(anew.total[i]);
  }
}

}  // namespace sazare::terms
